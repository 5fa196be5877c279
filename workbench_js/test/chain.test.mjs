import assert from "node:assert/strict";
import { test } from "node:test";
import { inverse, links, multiply, plainChain, rotation, tool, transform, workpieceJoints } from "../src/chain.js";

const close = (a, b) => a.forEach((v, k) => assert.ok(Math.abs(v - b[k]) < 1e-12, `${a} is not ${b}`));

/** C about the table's Z axis at (10, 0, 0), entered inverted, then X, Y, Z. */
const table = {
  joints: [
    { axis: 3, linear: false, direction: [0, 0, -1], point: [10, 0, 0] },
    { axis: 0, linear: true, direction: [1, 0, 0], point: [0, 0, 0] },
    { axis: 1, linear: true, direction: [0, 1, 0], point: [0, 0, 0] },
    { axis: 2, linear: true, direction: [0, 0, 1], point: [0, 0, 0] },
  ],
  flange: [0, 0, 50], orientation: [0, 0, 1], linkage: null, linkageOffset: null,
};

test("a turn is right-handed and about its point", () => {
  close(transform(rotation([0, 0, 1], 90, [1, 0, 0]), [2, 0, 0]), [1, 1, 0]);
});

test("a table turns the workpiece below a tool that stands", () => {
  // tip at (20, 0, 50 - 30) in the machine; the part turned by 90 degrees about (10, 0): (10, -10)
  close(tool(table, [20, 0, 0, 90], 30).tip, [10, -10, 20]);
  close(tool(table, [20, 0, 0, 90], 30).direction, [0, 0, 1]);
});

test("the machine bed is before the first linear axis", () => {
  assert.equal(workpieceJoints(table), 1);
  assert.equal(workpieceJoints(plainChain([{ name: "X" }, { name: "Y" }, { name: "Z" }])), 0);
});

test("a matrix and its inverse give the identity", () => {
  const m = links(table, [1, 2, 3, 40])[4];
  close(multiply(m, inverse(m)), [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]);
});

test("linear axes go through their linkage", () => {
  const linked = { ...table, linkage: [[1, 0.5, 0], [0, 1, 0], [0, 0, 1]], linkageOffset: [0, 0, 7] };
  close(tool(linked, [2, 4, 0, 0], 0).tip, [4, 4, 57]);
});

test("positions that are not there count as 0", () => {
  close(tool(table, [NaN, 0, 0, undefined], 0).tip, [0, 0, 50]);
});
