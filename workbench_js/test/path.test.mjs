import assert from "node:assert/strict";
import { test } from "node:test";
import { envelope, thinned } from "../src/decimate.js";
import { cursorAt, cursorOfRows, moveOf, poseAt, runsOf, runsOfLines, segments, stretchOf, timeAt, unpack, withMoves } from "../src/path.js";
import { chunkBoxes, pick } from "../src/pick.js";

/** Two stretches of three and two moves; line 5 ran twice, in file a and then in b. */
function example(end = undefined) {
  return withMoves({
    end, stretches: 2, axisNames: ["X", "C"], files: ["a", "b"], origin: [0, 0, 0],
    point: Float32Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 2, 1, 0, 9, 9, 9, 9, 8, 9, 7, 8, 9),
    axes: Float32Array.of(0, 0, 1, 10, 1, 20, 2, 40, 2, 40, 3, 40, 5, NaN),
    time: Float64Array.of(1, 2, 4, 5, 7), line: Uint32Array.of(5, 6, 5, 5, 2),
    motion: Uint8Array.of(0, 1, 1, 1, 1), stretch_first: Uint32Array.of(0, 3),
    stretch_file: Uint16Array.of(0, 1),
  });
}

test("points on the way belong to their move", () => {
  const path = example(Uint8Array.of(0, 0, 1, 0, 1));
  assert.equal(path.moves, 2);
  assert.deepEqual([0, 1, 2, 3, 4].map((row) => moveOf(path, row)), [0, 0, 0, 1, 1]);
  assert.deepEqual(poseAt(path, 1).tip, [2, 1, 0]);
  assert.deepEqual(poseAt(path, 1 / 3).tip, [1, 0, 0]);
  assert.deepEqual(poseAt(path, 1.5).tip, [9, 8, 9]);
  for (const cursor of [0.2, 1, 1.75, 2]) assert.ok(Math.abs(cursorAt(path, timeAt(path, cursor)) - cursor) < 1e-12);
  assert.equal(cursorOfRows(path, 4), 1.5);
  const tables = runsOfLines(path);
  assert.deepEqual([...runsOf(path, tables, "a", 5)], [0]);
  assert.deepEqual([...runsOf(path, tables, "b", 2)], [1]);
});

test("a container gives its arrays without a copy", () => {
  const header = new TextEncoder().encode(JSON.stringify({
    moves: 1, axes: ["X"], arrays: {
      line: { dtype: "<u4", shape: [1], offset: 256 }, stretch_first: { dtype: "<u4", shape: [1], offset: 264 },
    },
  }));
  const buffer = new ArrayBuffer(272), bytes = new Uint8Array(buffer), view = new DataView(buffer);
  bytes.set(new TextEncoder().encode("NCPATH01"));
  view.setUint32(8, header.length, true);
  bytes.set(header, 12);
  view.setUint32(256, 77, true);
  const path = unpack(buffer);
  assert.equal(path.line[0], 77);
  assert.equal(path.line.buffer, buffer);
  assert.throws(() => unpack(new ArrayBuffer(16)));
});

test("segments start where their own stretch starts", () => {
  const lines = segments(example());
  assert.deepEqual([...lines.subarray(12, 18)], [1, 1, 0, 2, 1, 0]);
  assert.deepEqual([...lines.subarray(18, 24)], [9, 9, 9, 9, 8, 9]);
});

test("a pose lies between the ends of its move", () => {
  const path = example();
  assert.deepEqual([0, 2, 3, 4].map((row) => stretchOf(path, row)), [0, 0, 1, 1]);
  assert.deepEqual(poseAt(path, 1.5), { row: 1, stretch: 0, part: 0.5, axes: [1, 15], tip: [1, 0.5, 0] });
  assert.deepEqual(poseAt(path, 3).tip, [2, 1, 0]);
  assert.equal(poseAt({ ...path, moves: 0 }, 0), null);
});

test("time and cursor lead back to each other", () => {
  const path = example();
  for (const cursor of [0, 0.5, 1, 2.25, 3, 4.75, 5]) {
    assert.ok(Math.abs(cursorAt(path, timeAt(path, cursor)) - cursor) < 1e-12);
  }
  assert.equal(timeAt(path, 2.5), 3);
  assert.equal(cursorAt(path, 99), 5);
});

test("a line knows all of its runs, file by file", () => {
  const path = example(), tables = runsOfLines(path);
  assert.deepEqual([...runsOf(path, tables, "a", 5)], [0, 2]);
  assert.deepEqual([...runsOf(path, tables, "b", 5)], [3]);
  assert.deepEqual([...runsOf(path, tables, "a", 2)], []);
  assert.deepEqual([...runsOf(path, tables, "a", 900)], []);
  assert.deepEqual([...runsOf(path, tables, "none", 5)], []);
});

test("thinned lines are connected, end where the path ends and keep gaps", () => {
  const moves = 1000, positions = new Float32Array(6 * moves), motion = new Uint8Array(moves).fill(1);
  for (let i = 0; i < moves; i++) {
    const gap = i >= 500 ? 50 : 0;
    positions.set([i + gap, 0, 0, i + 1 + gap, 0, 0], 6 * i);
  }
  const index = thinned(positions, motion, [0, 0, 0], [1050, 0, 0], 64);
  assert.ok(index.length / 2 < 140);
  const at = (vertex) => positions[3 * vertex];
  assert.equal(at(index[0]), 0);
  assert.equal(at(index[index.length - 1]), 1050);
  let covered = 0;
  for (let i = 0; i < index.length; i += 2) covered += at(index[i + 1]) - at(index[i]);
  assert.equal(covered, 1000);
});

test("an envelope keeps the extremes of every pixel", () => {
  const rows = 10_000, table = Float32Array.from({ length: rows }, (_, i) => (i === 4321 ? 99 : Math.sin(i)));
  const [x, y] = envelope(table, 1, 0, (i) => i, 0, rows, 100);
  assert.equal(x.length, 200);
  assert.equal(Math.max(...y), 99);
  assert.ok(x.every((v, i) => i === 0 || v >= x[i - 1]));
  assert.deepEqual([...envelope(table, 1, 0, (i) => i, 3, 6, 100)[0]], [3, 4, 5]);
});

test("the picked move is the nearest one on the screen, not the nearest one in depth", () => {
  const moves = 9000, positions = new Float32Array(6 * moves);
  for (let i = 0; i < moves; i++) positions.set([-1, i / moves - 0.5, i / moves, 1, i / moves - 0.5, i / moves], 6 * i);
  const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  const boxes = chunkBoxes(positions);
  for (const row of [0, 17, 4095, 4096, 8999]) {
    const y = (0.5 - positions[6 * row + 1] / 2) * 40_000;
    assert.equal(pick(positions, boxes, identity, 100, 40_000, 50, y, 8), row);
  }
  assert.equal(pick(positions, boxes, identity, 100, 40_000, 50, 100, 8), -1);
});
