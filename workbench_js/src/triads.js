// Coordinate systems as labelled triads.

import * as THREE from "three";
import { colour } from "./dom.js";
import { label, release } from "./labels.js";

const LETTERS = ["X", "Y", "Z"];
export const LETTER_COLOURS = ["#e5484d", "#2f9e5f", "#3e7bfa"];

/** A triad with the name of its system; `size` in mm. rotation: rows; its columns are the axes. */
export function triad(name, rotation, shift, size) {
  const group = new THREE.Group();
  for (let k = 0; k < 3; k++) {
    const way = new THREE.Vector3(rotation[0][k], rotation[1][k], rotation[2][k]);
    const arrow = new THREE.ArrowHelper(way, new THREE.Vector3(), size, LETTER_COLOURS[k], size * 0.2, size * 0.08);
    arrow.line.material.depthTest = arrow.cone.material.depthTest = false;
    arrow.renderOrder = 4;
    const letter = label(LETTERS[k], LETTER_COLOURS[k], colour("panel"), 11);
    letter.position.copy(way.multiplyScalar(size * 1.12));
    group.add(arrow, letter);
  }
  const title = label(name, colour("text"), colour("panel"), 13);
  title.position.set(-size * 0.12, -size * 0.12, -size * 0.12);
  group.add(title);
  group.position.set(...shift);
  return group;
}

/** Triads of several systems in one group; those in one place share one label. */
export function triads(systems, size) {
  const group = new THREE.Group();
  const places = new Map();
  for (const system of systems) {
    const key = JSON.stringify([system.rotation, system.shift].flat(3).map((v) => v.toFixed(6)));
    if (places.has(key)) places.get(key).names.push(system.name);
    else places.set(key, { ...system, names: [system.name] });
  }
  let scale = 1;
  for (const { names, rotation, shift } of places.values()) {
    group.add(triad(names.join(" = "), rotation, shift, size * scale));
    scale *= 0.82;
  }
  return group;
}

export { release };
