// The machine as a chain: what each link carries, moved by axis positions. A picture of the
// kinematics, not of the machine's true shape, which no list describes.

import * as THREE from "three";
import { IDENTITY, inverse, links, multiply, plainChain, workpieceJoints } from "./chain.js";
import { AXIS_COLOURS, colour } from "./dom.js";
import { label, release } from "./labels.js";

const NORMAL = new THREE.Vector3(0, 1, 0);

export class MachineModel {
  /** chain: see chain.js. box: {low, high} of the path, mm. ranges: [low, high] that each channel
      axis uses. size: of the drawn parts, mm. */
  constructor(chain, axes, box, ranges, size) {
    this.chain = chain ?? plainChain(axes);
    this.ranges = axes.map((axis, i) => rail(axis, ranges[i], size));
    this.size = size;
    this.box = box;
    this.root = new THREE.Group();
    this.groups = [...this.chain.joints, null].map(() => {
      const group = new THREE.Group();
      group.matrixAutoUpdate = false;
      this.root.add(group);
      return group;
    });
    this.body = new THREE.MeshStandardMaterial({ color: colour("machine"), roughness: 0.75, metalness: 0.1 });
    this.dark = new THREE.MeshStandardMaterial({ color: colour("machine-dark"), roughness: 0.8 });
    this.glass = new THREE.MeshStandardMaterial({ color: colour("machine"), transparent: true, opacity: 0.28, depthWrite: false });
    this.tool = new THREE.Group();
    this.build();
    this.setLength(0);
    this.move(axes.map(() => 0));
  }

  // --- building --------------------------------------------------------------------------------

  build() {
    const { joints } = this.chain, bed = workpieceJoints(this.chain);
    const anchors = this.anchors(bed);
    joints.forEach((joint, k) => this.addJoint(joint, k, anchors[k]));
    for (let k = 0; k + 1 < joints.length; k++) {
      if (k !== bed - 1) this.strut(this.groups[k + 1], anchors[k], this.middle(joints[k + 1], anchors[k + 1]));
    }
    const before = bed > 0 ? anchors[bed - 1] : this.tableCentre();
    if (anchors[bed]) this.addBed(this.groups[bed], before, this.middle(joints[bed], anchors[bed]));
    if (joints.length > bed) this.strut(this.groups[joints.length], anchors[joints.length - 1], this.chain.flange);
    this.addTable(this.groups[0]);
    this.groups[joints.length].add(this.tool);
  }

  /** A place for the picture of each joint, with all axes at 0: the point of a rotary axis that is
      nearest to its neighbour, and linear axes lined up behind each other. */
  anchors(bed) {
    const { joints, flange, orientation } = this.chain, found = new Array(joints.length);
    const up = new THREE.Vector3(...orientation);
    let at = new THREE.Vector3(...flange);
    for (let k = joints.length - 1; k >= bed; k--) {
      at = joints[k].linear ? at.clone().addScaledVector(up, this.size * 0.3).addScaledVector(this.aside(joints[k], up), this.size * 0.28) : onAxis(joints[k], at);
      found[k] = at.toArray();
    }
    at = new THREE.Vector3(...this.tableCentre());
    for (let k = 0; k < bed; k++) {
      const down = this.size * (k ? 0.24 : 0.1);
      at = joints[k].linear ? at.clone().setZ(at.z - down) : onAxis(joints[k], at.clone().setZ(at.z - down));
      found[k] = at.toArray();
    }
    return found;
  }

  /** Linear axes stand a little aside, so that their rails do not hide each other. */
  aside(joint, up) {
    const way = up.clone().cross(new THREE.Vector3(...joint.direction));
    return way.lengthSq() > 0.1 ? way.normalize() : new THREE.Vector3(0, 1, 0);
  }

  /** The middle of the rail of a linear axis, else the place of the joint. */
  middle(joint, anchor) {
    if (!joint.linear) return anchor;
    const [low, high] = this.ranges[joint.axis] ?? [0, 0];
    return anchor.map((v, k) => v + (joint.direction[k] * (low + high)) / 2);
  }

  tableCentre() {
    const { low, high } = this.box;
    return [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2] - this.size * 0.06];
  }

  addTable(group) {
    const { low, high } = this.box, s = this.size;
    const span = [0, 1].map((k) => Math.max(high[k] - low[k] + 0.25 * s, 0.6 * s));
    const plate = new THREE.Mesh(new THREE.BoxGeometry(span[0], span[1], s * 0.04), this.glass);
    const [x, y, z] = this.tableCentre();
    plate.position.set(x, y, z);
    group.add(plate, edges(plate, this.dark.color));
  }

  addBed(group, from, to) {
    const s = this.size, foot = Math.min(from[2], to[2], this.tableCentre()[2]) - s * 0.3;
    const corner = [to[0], Math.max(to[1] + s * 0.3, this.box.high[1] + s * 0.4), foot];
    this.strut(group, from, [from[0], from[1], foot], 0.1);
    this.strut(group, [from[0], from[1], foot], corner, 0.1);
    this.strut(group, corner, [corner[0], corner[1], to[2]], 0.1);
    this.strut(group, [corner[0], corner[1], to[2]], to, 0.08);
  }

  addJoint(joint, k, anchor) {
    if (!anchor) return;
    const shade = AXIS_COLOURS[joint.axis % AXIS_COLOURS.length];
    const fixed = new THREE.Group(), moving = new THREE.Group();
    const turn = new THREE.Quaternion().setFromUnitVectors(NORMAL, new THREE.Vector3(...joint.direction));
    for (const part of [fixed, moving]) { part.position.set(...anchor); part.quaternion.copy(turn); }
    if (joint.linear) this.linear(joint, fixed, moving, shade); else this.rotary(fixed, moving, shade);
    const name = label(joint.name, shade, colour("panel"), 14);
    const end = joint.linear ? (this.ranges[joint.axis]?.[1] ?? 0) + this.size * 0.2 : this.size * 0.4;
    name.position.set(...anchor).addScaledVector(new THREE.Vector3(...joint.direction), end);
    this.groups[k].add(fixed, name);
    this.groups[k + 1].add(moving);
  }

  /** A rail over the travel of the axis and a carriage on it; along Y of its own group. */
  linear(joint, fixed, moving, shade) {
    const s = this.size, [low, high] = this.ranges[joint.axis] ?? [-s, s];
    const bar = new THREE.Mesh(new THREE.BoxGeometry(s * 0.045, high - low + s * 0.16, s * 0.045), this.dark);
    bar.position.y = (low + high) / 2;
    fixed.add(bar, arrow(high + s * 0.08, s * 0.16, shade));
    moving.add(new THREE.Mesh(new THREE.BoxGeometry(s * 0.14, s * 0.16, s * 0.1), this.body), band(s, shade));
  }

  /** The axis of turning with its sense, and a hub with a pointer; about Y of its own group. */
  rotary(fixed, moving, shade) {
    const s = this.size;
    const line = new THREE.Line(
      new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(0, -s * 0.36, 0), new THREE.Vector3(0, s * 0.36, 0)]),
      new THREE.LineBasicMaterial({ color: shade }),
    );
    const ring = new THREE.Mesh(new THREE.TorusGeometry(s * 0.12, s * 0.008, 8, 48, Math.PI * 1.6), new THREE.MeshBasicMaterial({ color: shade }));
    ring.rotation.x = -Math.PI / 2;
    const tip = new THREE.Mesh(new THREE.ConeGeometry(s * 0.022, s * 0.06, 16), new THREE.MeshBasicMaterial({ color: shade }));
    const end = Math.PI * 1.6;
    tip.position.set(s * 0.12 * Math.cos(end), 0, -s * 0.12 * Math.sin(end));
    tip.quaternion.setFromUnitVectors(NORMAL, new THREE.Vector3(-Math.sin(end), 0, -Math.cos(end)));
    fixed.add(line, ring, tip, arrow(s * 0.3, s * 0.08, shade));
    const hub = new THREE.Mesh(new THREE.CylinderGeometry(s * 0.08, s * 0.08, s * 0.13, 32), this.body);
    const pointer = new THREE.Mesh(new THREE.BoxGeometry(s * 0.1, s * 0.03, s * 0.02), new THREE.MeshStandardMaterial({ color: shade }));
    pointer.position.set(s * 0.07, 0, 0);
    moving.add(hub, pointer);
  }

  strut(group, from, to, thick = 0.05) {
    const a = new THREE.Vector3(...from), way = new THREE.Vector3(...to).sub(a), length = way.length();
    if (length < 1e-6) return;
    const s = this.size * thick, bar = new THREE.Mesh(new THREE.BoxGeometry(s, length, s), this.glass);
    bar.position.copy(a).addScaledVector(way, 0.5);
    bar.quaternion.setFromUnitVectors(NORMAL, way.normalize());
    group.add(bar, edges(bar, this.dark.color));
  }

  // --- moving ----------------------------------------------------------------------------------

  /** The tool of a length in mm, from the flange to its tip. */
  setLength(length) {
    if (this.length === length) return;
    this.length = length;
    for (const part of [...this.tool.children]) release(part);
    const s = this.size, { flange, orientation } = this.chain;
    const way = new THREE.Vector3(...orientation), shank = Math.max(length, s * 0.02);
    const steel = new THREE.MeshStandardMaterial({ color: colour("tool"), roughness: 0.35, metalness: 0.5 });
    const tip = Math.min(shank * 0.4, s * 0.07), rod = new THREE.Mesh(new THREE.CylinderGeometry(s * 0.02, s * 0.02, shank - tip, 24), steel);
    const cone = new THREE.Mesh(new THREE.ConeGeometry(s * 0.02, tip, 24), steel);
    const holder = new THREE.Mesh(new THREE.CylinderGeometry(s * 0.05, s * 0.035, s * 0.07, 32), this.body);
    const turn = new THREE.Quaternion().setFromUnitVectors(NORMAL, way);
    const place = (part, along, flip) => {
      part.position.set(...flange).addScaledVector(way, along);
      part.quaternion.copy(turn);
      if (flip) part.rotateX(Math.PI);
      this.tool.add(part);
    };
    place(rod, -(shank - tip) / 2);
    place(cone, -(shank - tip / 2), true);
    place(holder, s * 0.02);
  }

  /** Axis positions by channel index. Returns the matrix of the workpiece for the chosen frame. */
  move(positions, inMachine = true) {
    const found = links(this.chain, positions);
    const base = inMachine ? inverse(found[workpieceJoints(this.chain)]) : IDENTITY;
    found.forEach((matrix, k) => setMatrix(this.groups[k], multiply(base, matrix)));
    return base;
  }

  dispose() { release(this.root); }
}

/** Writes a matrix of chain.js into a node of the scene. */
export function setMatrix(node, m) {
  node.matrixAutoUpdate = false;
  node.matrix.set(...m, 0, 0, 0, 1);
  node.matrixWorldNeedsUpdate = true;
}

/** The part of the travel that is drawn: what the path uses and a little more, inside the limits. */
function rail(axis, used, size) {
  const low = Math.min(0, used?.[0] ?? 0) - size * 0.14, high = Math.max(0, used?.[1] ?? 0) + size * 0.14;
  return axis.limits ? [Math.max(low, Math.min(axis.limits[0], 0)), Math.min(high, Math.max(axis.limits[1], 0))] : [low, high];
}

/** The point of a rotary axis that is nearest to a place. */
function onAxis(joint, place) {
  const point = new THREE.Vector3(...joint.point), way = new THREE.Vector3(...joint.direction);
  return point.addScaledVector(way, place.clone().sub(point).dot(way));
}

function arrow(from, length, shade) {
  const tip = new THREE.Mesh(new THREE.ConeGeometry(length * 0.22, length * 0.5, 16), new THREE.MeshBasicMaterial({ color: shade }));
  tip.position.y = from + length * 0.25;
  return tip;
}

function band(s, shade) {
  return new THREE.Mesh(new THREE.BoxGeometry(s * 0.145, s * 0.03, s * 0.105), new THREE.MeshStandardMaterial({ color: shade }));
}

function edges(mesh, shade) {
  const lines = new THREE.LineSegments(new THREE.EdgesGeometry(mesh.geometry), new THREE.LineBasicMaterial({ color: shade, transparent: true, opacity: 0.55 }));
  lines.position.copy(mesh.position);
  lines.quaternion.copy(mesh.quaternion);
  return lines;
}
