// The move nearest to a point on the screen, exact in pixels, without the graphics card. Pure.

const CHUNK = 4096;

/** Boxes around every CHUNK moves: 6 numbers each. Made once for a path. */
export function chunkBoxes(positions) {
  const moves = positions.length / 6, chunks = Math.ceil(moves / CHUNK);
  const boxes = new Float32Array(chunks * 6);
  for (let c = 0; c < chunks; c++) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let v = c * CHUNK * 2; v < Math.min(moves, (c + 1) * CHUNK) * 2; v++) {
      for (let k = 0; k < 3; k++) {
        const value = positions[3 * v + k];
        if (value < low[k]) low[k] = value;
        if (value > high[k]) high[k] = value;
      }
    }
    boxes.set([...low, ...high], 6 * c);
  }
  return boxes;
}

/** Row of the move nearest to (x, y) in pixels, within `reach` pixels; -1 when there is none.
    matrix: 16 numbers, column by column, from the coordinates of the path to clip space.
    Nearest in pixels counts first, nearer to the eye second. */
export function pick(positions, boxes, matrix, width, height, x, y, reach = 8) {
  const m = matrix, moves = positions.length / 6;
  const project = (px, py, pz, out) => {
    const w = m[3] * px + m[7] * py + m[11] * pz + m[15];
    out[2] = m[2] * px + m[6] * py + m[10] * pz + m[14];
    out[3] = w;
    out[0] = (((m[0] * px + m[4] * py + m[8] * pz + m[12]) / w) * 0.5 + 0.5) * width;
    out[1] = (0.5 - ((m[1] * px + m[5] * py + m[9] * pz + m[13]) / w) * 0.5) * height;
    return w > 1e-9;
  };
  const a = [0, 0, 0, 0], b = [0, 0, 0, 0];
  let best = -1, bestDistance = reach * reach, bestDepth = Infinity;
  for (let c = 0; c * CHUNK < moves; c++) {
    if (!near(boxes, c, project, a, x, y, Math.sqrt(bestDistance) + 1)) continue;
    const stop = Math.min(moves, (c + 1) * CHUNK);
    for (let i = c * CHUNK; i < stop; i++) {
      const p = 6 * i;
      if (!project(positions[p], positions[p + 1], positions[p + 2], a)) continue;
      if (!project(positions[p + 3], positions[p + 4], positions[p + 5], b)) continue;
      const dx = b[0] - a[0], dy = b[1] - a[1], length = dx * dx + dy * dy;
      let t = length ? ((x - a[0]) * dx + (y - a[1]) * dy) / length : 0;
      t = t < 0 ? 0 : t > 1 ? 1 : t;
      const ex = a[0] + t * dx - x, ey = a[1] + t * dy - y, distance = ex * ex + ey * ey;
      if (distance > bestDistance + 1e-6) continue;
      const depth = (1 - t) * (a[2] / a[3]) + t * (b[2] / b[3]);
      if (distance < bestDistance - 0.25 || depth < bestDepth) {
        best = i; bestDistance = Math.min(distance, bestDistance); bestDepth = depth;
      }
    }
  }
  return best;
}

function near(boxes, c, project, out, x, y, reach) {
  let left = Infinity, right = -Infinity, top = Infinity, bottom = -Infinity;
  for (let corner = 0; corner < 8; corner++) {
    const ok = project(
      boxes[6 * c + (corner & 1 ? 3 : 0)], boxes[6 * c + (corner & 2 ? 4 : 1)],
      boxes[6 * c + (corner & 4 ? 5 : 2)], out,
    );
    if (!ok) return true;
    left = Math.min(left, out[0]); right = Math.max(right, out[0]);
    top = Math.min(top, out[1]); bottom = Math.max(bottom, out[1]);
  }
  return x >= left - reach && x <= right + reach && y >= top - reach && y <= bottom + reach;
}
