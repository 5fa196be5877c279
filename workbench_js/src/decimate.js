// Fewer lines and points with the same look. Pure.

/** Pairs of vertices of LineSegments that leave out moves inside one cell of a grid of
    `cells` along the longest side of the path. `motion` changes are kept. */
export function thinned(positions, motion, low, high, cells) {
  const moves = motion.length;
  const size = Math.max(high[0] - low[0], high[1] - low[1], high[2] - low[2], 1e-9) / cells;
  const out = new Uint32Array(moves * 2);
  let count = 0, kept = -1, cell = NaN;
  for (let i = 0; i < moves; i++) {
    const at = 6 * i;
    const broken = i > 0 && (positions[at] !== positions[at - 3] || positions[at + 1] !== positions[at - 2]
      || positions[at + 2] !== positions[at - 1] || motion[i] !== motion[i - 1]);
    if (kept < 0 || broken) {
      if (kept >= 0 && kept !== 2 * i - 1) { out[count++] = kept; out[count++] = 2 * i - 1; }
      kept = 2 * i;
      cell = NaN;
    }
    const own = (Math.floor((positions[at + 3] - low[0]) / size) * 4096
      + Math.floor((positions[at + 4] - low[1]) / size)) * 4096
      + Math.floor((positions[at + 5] - low[2]) / size);
    if (own !== cell) {
      out[count++] = kept;
      out[count++] = 2 * i + 1;
      kept = 2 * i + 1;
      cell = own;
    }
  }
  if (kept >= 0 && kept !== 2 * moves - 1) { out[count++] = kept; out[count++] = 2 * moves - 1; }
  return out.slice(0, count);
}

/** Smallest and largest value for each of `pixels` columns between rows `from` and `to` of one
    column of a table: [x, values], two points a column, in the order of the rows. */
export function envelope(table, width, column, rowOf, from, to, pixels) {
  const count = to - from;
  if (count <= 2 * pixels) {
    const x = new Float64Array(Math.max(0, count)), y = new Float64Array(Math.max(0, count));
    for (let i = 0; i < count; i++) {
      x[i] = from + i;
      y[i] = table[rowOf(from + i) * width + column];
    }
    return [x, y];
  }
  const x = new Float64Array(2 * pixels), y = new Float64Array(2 * pixels);
  for (let p = 0; p < pixels; p++) {
    const first = from + Math.floor((p * count) / pixels);
    const last = from + Math.floor(((p + 1) * count) / pixels);
    let low = Infinity, high = -Infinity, lowAt = first, highAt = first;
    for (let i = first; i < last; i++) {
      const value = table[rowOf(i) * width + column];
      if (value < low) { low = value; lowAt = i; }
      if (value > high) { high = value; highAt = i; }
    }
    if (low === Infinity) low = high = NaN;
    const rising = lowAt <= highAt;
    x[2 * p] = first; x[2 * p + 1] = Math.max(first, last - 1);
    y[2 * p] = rising ? low : high; y[2 * p + 1] = rising ? high : low;
  }
  return [x, y];
}
