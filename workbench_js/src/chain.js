// Where the links of a machine stand for given axis positions. Pure; mm and degrees.
// A matrix is 12 numbers, three rows of (rotation | shift). See kinematics/kernels.py.

export const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

export function multiply(a, b) {
  const out = new Array(12);
  for (let i = 0; i < 3; i++) {
    for (let j = 0; j < 4; j++) {
      out[4 * i + j] = a[4 * i] * b[j] + a[4 * i + 1] * b[4 + j] + a[4 * i + 2] * b[8 + j]
        + (j === 3 ? a[4 * i + 3] : 0);
    }
  }
  return out;
}

export function inverse(m) {
  const out = new Array(12);
  for (let i = 0; i < 3; i++) {
    for (let j = 0; j < 3; j++) out[4 * i + j] = m[4 * j + i];
    out[4 * i + 3] = -(m[i] * m[3] + m[4 + i] * m[7] + m[8 + i] * m[11]);
  }
  return out;
}

export function transform(m, p) {
  return [0, 1, 2].map((i) => m[4 * i] * p[0] + m[4 * i + 1] * p[1] + m[4 * i + 2] * p[2] + m[4 * i + 3]);
}

export const translation = (v) => [1, 0, 0, v[0], 0, 1, 0, v[1], 0, 0, 1, v[2]];

/** Right-handed turn by degrees about a unit vector through a point. */
export function rotation(axis, degrees, point) {
  const angle = (degrees * Math.PI) / 180, s = Math.sin(angle), c = Math.cos(angle);
  const [x, y, z] = axis, t = 1 - c;
  const r = [
    t * x * x + c, t * x * y - s * z, t * x * z + s * y, 0,
    t * x * y + s * z, t * y * y + c, t * y * z - s * x, 0,
    t * x * z - s * y, t * y * z + s * x, t * z * z + c, 0,
  ];
  const moved = transform(r, point);
  for (let i = 0; i < 3; i++) r[4 * i + 3] = point[i] - moved[i];
  return r;
}

/** The chain of a machine that has no kinematics: its main axes along X, Y and Z. */
export function plainChain(axes) {
  const joints = axes.slice(0, 3).map((axis, i) => ({
    axis: i, name: axis.name, linear: true, point: [0, 0, 0],
    direction: [0, 1, 2].map((k) => (k === i ? 1 : 0)),
  }));
  return { id: null, joints, flange: [0, 0, 0], orientation: [0, 0, 1], linkage: null, linkageOffset: null };
}

/** Positions of the axes as the joints move: the linear axes through their linkage. */
function moved(chain, positions) {
  if (!chain.linkage) return positions;
  const out = positions.slice();
  for (let i = 0; i < 3; i++) {
    out[i] = chain.linkageOffset[i];
    for (let j = 0; j < 3; j++) out[i] += chain.linkage[i][j] * positions[j];
  }
  return out;
}

/** Matrices from each link to the workpiece: the workpiece itself first, the tool last. */
export function links(chain, positions) {
  const found = [IDENTITY];
  const values = moved(chain, positions.map((v) => (Number.isFinite(v) ? v : 0)));
  for (const joint of chain.joints) {
    const value = values[joint.axis] ?? 0;
    const own = joint.linear
      ? translation(joint.direction.map((d) => d * value))
      : rotation(joint.direction, value, joint.point);
    found.push(multiply(found[found.length - 1], own));
  }
  return found;
}

/** Tool tip (mm) and direction from tip to flange, in the workpiece. */
export function tool(chain, positions, length) {
  const last = links(chain, positions).at(-1);
  const tip = chain.flange.map((v, k) => v - length * chain.orientation[k]);
  const turned = multiply(last, translation([0, 0, 0]));
  for (const i of [3, 7, 11]) turned[i] = 0;
  return { tip: transform(last, tip), direction: transform(turned, chain.orientation) };
}

/** Joints on the workpiece's side of the machine bed: those before the first linear axis. */
export function workpieceJoints(chain) {
  const first = chain.joints.findIndex((joint) => joint.linear);
  return first < 0 ? 0 : first;
}
