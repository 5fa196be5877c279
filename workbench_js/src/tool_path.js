// The path as lines: colours, level of detail, the marked move.

import * as THREE from "three";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { thinned } from "./decimate.js";
import { AXIS_COLOURS, colour } from "./dom.js";
import { endRow, firstRow, segments } from "./path.js";
import { chunkBoxes, pick } from "./pick.js";

const GRIDS = [512, 256, 128, 64];
const MOST_MARKED = 60;

/** Lines of one path, in coordinates relative to `path.origin`. */
export class ToolPath {
  constructor(path) {
    this.path = path;
    this.group = new THREE.Group();
    this.positions = segments(path);
    this.boxes = chunkBoxes(this.positions);
    this.colours = new Uint8Array(path.rows * 8);
    const radius = Math.hypot(...path.high.map((v, k) => v - path.low[k])) / 2 || 1;
    this.sphere = new THREE.Sphere(new THREE.Vector3(), radius);
    this.attributes = {
      position: new THREE.BufferAttribute(this.positions, 3),
      color: new THREE.BufferAttribute(this.colours, 4, true),
    };
    this.material = new THREE.LineBasicMaterial({ vertexColors: true, toneMapped: false });
    this.full = this.lines(null);
    this.levels = null;
    this.group.add(this.full);
    this.mark = fatLines(4.5);
    this.others = fatLines(2);
    this.group.add(this.others, this.mark);
  }

  lines(index) {
    const geometry = new THREE.BufferGeometry();
    for (const [name, attribute] of Object.entries(this.attributes)) geometry.setAttribute(name, attribute);
    if (index) geometry.setIndex(new THREE.BufferAttribute(index, 1));
    geometry.boundingSphere = this.sphere;
    return new THREE.LineSegments(geometry, this.material);
  }

  /** Shows at most about `budget` lines; Infinity for all. */
  detail(budget) {
    if (this.path.rows <= budget) {
      this.show(this.full);
      return;
    }
    this.levels ??= GRIDS.map((cells) => this.lines(
      thinned(this.positions, this.path.motion, this.relative(this.path.low), this.relative(this.path.high), cells),
    ));
    this.show(this.levels.find((level) => level.geometry.index.count / 2 <= budget) ?? this.levels.at(-1));
  }

  relative(point) { return point.map((v, k) => v - this.path.origin[k]); }

  show(lines) {
    if (this.shown === lines) return;
    this.group.remove(this.shown ?? this.full);
    this.group.add(lines);
    this.shown = lines;
  }

  /** mode: `motion`, `system`, or the name of an axis. */
  paint(mode) {
    const { path } = this;
    const words = new Uint32Array(this.colours.buffer);
    const rapid = word(rgb(colour("rapid"))), feed = word(rgb(colour("feed")));
    const column = path.axisNames.indexOf(mode), [low, high] = column >= 0 ? this.range(column) : [0, 1];
    const palette = AXIS_COLOURS.map((shade) => word(rgb(shade)));
    const ramp = Uint32Array.from({ length: 256 }, (_, i) => word(gradient(i / 255))), none = word([128, 128, 128]);
    for (let s = 0; s < path.stretches; s++) {
      const stop = s + 1 < path.stretches ? path.stretch_first[s + 1] : path.rows;
      for (let i = path.stretch_first[s]; i < stop; i++) {
        if (column >= 0) {
          for (const end of [0, 1]) {
            const value = path.axes[(i + s + end) * path.axisNames.length + column];
            words[2 * i + end] = value === value ? ramp[Math.round((255 * (value - low)) / (high - low))] : none;
          }
          continue;
        }
        const own = mode === "system" ? palette[path.stretch_system[s] % palette.length] : path.motion[i] ? feed : rapid;
        words[2 * i] = words[2 * i + 1] = own;
      }
    }
    this.attributes.color.needsUpdate = true;
  }

  range(column) {
    const n = this.path.axisNames.length;
    let low = Infinity, high = -Infinity;
    for (let i = column; i < this.path.axes.length; i += n) {
      const value = this.path.axes[i];
      if (value < low) low = value;
      if (value > high) high = value;
    }
    return low < high ? [low, high] : [low - 0.5, low + 0.5];
  }

  /** Marks a move, and fainter the other moves of its line where they are few. */
  select(move, runs, width, height) {
    this.mark.visible = move >= 0 && move < this.path.moves;
    if (this.mark.visible && this.markOf !== move) setLines(this.mark, this.linesOf(move), colour("mark"));
    this.markOf = move;
    this.others.visible = runs.length > 1 && runs.length <= MOST_MARKED;
    if (this.others.visible && this.othersOf !== runs) {
      setLines(this.others, [...runs].flatMap((run) => [...this.linesOf(run)]), colour("mark"));
      this.othersOf = runs;
    }
    for (const lines of [this.mark, this.others]) lines.material.resolution.set(width, height);
  }

  linesOf(move) { return this.positions.subarray(6 * firstRow(this.path, move), 6 * endRow(this.path, move) + 6); }

  /** The row under a pixel, -1 for none. */
  pick(camera, width, height, x, y, reach) {
    const matrix = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse)
      .multiply(this.group.matrixWorld);
    return pick(this.positions, this.boxes, matrix.elements, width, height, x, y, reach);
  }

  dispose() {
    for (const lines of [this.full, ...(this.levels ?? []), this.mark, this.others]) lines.geometry.dispose();
    this.material.dispose();
    this.group.removeFromParent();
  }
}

function fatLines(width) {
  const material = new LineMaterial({ linewidth: width, depthTest: false, transparent: true, opacity: width > 3 ? 1 : 0.3 });
  const lines = new LineSegments2(new LineSegmentsGeometry(), material);
  lines.visible = false;
  lines.frustumCulled = false;
  lines.renderOrder = 5;
  return lines;
}

function setLines(lines, positions, shade) {
  lines.geometry.dispose();
  lines.geometry = new LineSegmentsGeometry();
  lines.geometry.setPositions(positions);
  lines.material.color.set(shade);
}

/** A colour as three bytes in the linear space that vertex colours are in. */
function rgb(text) {
  const c = new THREE.Color(text);
  return [c.r, c.g, c.b].map((v) => Math.round(255 * v));
}

const STOPS = ["#2c4fd8", "#1aa5b8", "#46b04a", "#e0b020", "#d8402c"].map((c) => rgb(c));

/** Three bytes and full opacity as one number of four bytes. */
const word = ([r, g, b]) => ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;

function gradient(part) {
  const at = Math.min(0.9999, Math.max(0, part)) * (STOPS.length - 1), k = Math.floor(at);
  return [0, 1, 2].map((i) => Math.round(STOPS[k][i] + (STOPS[k + 1][i] - STOPS[k][i]) * (at - k)));
}
