// The path of a run: the binary answer as typed arrays, without a copy. Pure; see path_buffer.py.

const MAGIC = "NCPATH01";
const KINDS = {
  "<f4": Float32Array, "<f8": Float64Array, "<u4": Uint32Array, "<u2": Uint16Array,
  "<i4": Int32Array, "|u1": Uint8Array,
};

/** Header fields and arrays of a container. Throws for anything else. */
export function unpack(buffer) {
  const bytes = new Uint8Array(buffer);
  const magic = String.fromCharCode(...bytes.subarray(0, 8));
  if (magic !== MAGIC) throw new Error("this is not a path");
  const length = new DataView(buffer).getUint32(8, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(12, 12 + length)));
  const path = { ...header, axisNames: header.axes };
  for (const [name, { dtype, shape, offset }] of Object.entries(header.arrays)) {
    const count = shape.reduce((product, n) => product * n, 1);
    path[name] = new KINDS[dtype](buffer, offset, count);
  }
  path.stretches = path.stretch_first.length;
  return withMoves(path);
}

/** Adds which rows are the ends of moves: `ends` by move and `moveOf` by row, null where every row
    is one (a run without points on the way). */
export function withMoves(path) {
  path.rows = path.line.length;
  path.moves = path.rows;
  path.ends = path.moveOf = null;
  if (path.end && path.end.includes(0)) {
    path.moveOf = new Uint32Array(path.rows);
    let count = 0;
    for (let i = 0; i < path.rows; i++) { path.moveOf[i] = count; count += path.end[i]; }
    path.moves = count;
    path.ends = new Uint32Array(count);
    for (let i = 0, k = 0; i < path.rows; i++) if (path.end[i]) path.ends[k++] = i;
  }
  return path;
}

/** The row in which a move ends, its first row, and the move that a row belongs to. */
export const endRow = (path, move) => (path.ends ? path.ends[move] : move);
export const firstRow = (path, move) => (path.ends && move ? path.ends[move - 1] + 1 : path.ends ? 0 : move);
export const moveOf = (path, row) => (path.moveOf ? Math.min(path.moves - 1, path.moveOf[row]) : row);

/** Rows behind a cursor with the part of the last one, and back: the rows of a move share it. */
function rowsAt(path, cursor) {
  if (!path.ends) return cursor;
  const move = Math.max(0, Math.min(path.moves - 1, Math.ceil(cursor) - 1));
  const first = firstRow(path, move), count = endRow(path, move) - first + 1;
  return first + Math.min(1, Math.max(0, cursor - move)) * count;
}

export function cursorOfRows(path, rows) {
  if (!path.ends) return rows;
  const move = moveOf(path, Math.max(0, Math.min(path.rows - 1, Math.ceil(rows) - 1)));
  const first = firstRow(path, move), count = endRow(path, move) - first + 1;
  return move + Math.min(1, Math.max(0, (rows - first) / count));
}

export const EMPTY = {
  moves: 0, rows: 0, ends: null, moveOf: null, stretches: 0, axisNames: [], axes: new Float32Array(0), files: [], systems: [], origin: [0, 0, 0], low: [0, 0, 0],
  high: [0, 0, 0], point: new Float32Array(0), time: new Float64Array(0), pole: new Float32Array(0),
  line: new Uint32Array(0), motion: new Uint8Array(0), stretch_first: new Uint32Array(0),
  stretch_file: new Uint16Array(0), stretch_system: new Uint16Array(0),
  stretch_model: new Int32Array(0), stretch_length: new Float32Array(0),
};

/** The stretch that holds a row. */
export function stretchOf(path, row) {
  let low = 0, high = path.stretches - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (path.stretch_first[middle] <= row) low = middle; else high = middle - 1;
  }
  return low;
}

/** End points of every row, relative to `origin`: 6 numbers a row, as LineSegments takes them. */
export function segments(path) {
  const out = new Float32Array(path.rows * 6);
  for (let s = 0; s < path.stretches; s++) {
    const stop = s + 1 < path.stretches ? path.stretch_first[s + 1] : path.rows;
    for (let i = path.stretch_first[s]; i < stop; i++) {
      const from = 3 * (i + s);
      for (let k = 0; k < 6; k++) out[6 * i + k] = path.point[from + k];
    }
  }
  return out;
}

/** The place `cursor` on the path: 0 is the start, n the end of the n-th move.
    Axis positions, tool tip relative to `origin`, the row, its stretch, and the part done. */
export function poseAt(path, cursor) {
  if (!path.moves) return null;
  const rows = rowsAt(path, cursor);
  const row = Math.min(path.rows - 1, Math.max(0, Math.ceil(rows) - 1));
  const part = Math.min(1, Math.max(0, rows - row));
  const stretch = stretchOf(path, row);
  const from = row + stretch, n = path.axisNames.length;
  const axes = new Array(n), tip = new Array(3);
  for (let a = 0; a < n; a++) {
    const x = path.axes[from * n + a], y = path.axes[(from + 1) * n + a];
    axes[a] = part === 1 || Number.isNaN(x) ? y : x + (y - x) * part;
  }
  for (let k = 0; k < 3; k++) {
    const x = path.point[from * 3 + k], y = path.point[(from + 1) * 3 + k];
    tip[k] = x + (y - x) * part;
  }
  return { row, stretch, part, axes, tip };
}

/** Seconds of the playback at a cursor, and back. */
export function timeAt(path, cursor) {
  if (!path.moves || cursor <= 0) return 0;
  const rows = rowsAt(path, cursor), row = Math.min(path.rows - 1, Math.ceil(rows) - 1);
  const before = row ? path.time[row - 1] : 0;
  return before + (path.time[row] - before) * Math.min(1, rows - row);
}

export function cursorAt(path, time) {
  if (!path.moves || time <= 0) return 0;
  let low = 0, high = path.rows;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (path.time[middle] < time) low = middle + 1; else high = middle;
  }
  if (low >= path.rows) return path.moves;
  const before = low ? path.time[low - 1] : 0;
  return cursorOfRows(path, low + (time - before) / (path.time[low] - before));
}

/** For every line of every file the moves that it made, in order. */
export function runsOfLines(path) {
  const perFile = path.files.map(() => ({ most: 0, count: 0 }));
  each(path, (i, file) => {
    perFile[file].count++;
    perFile[file].most = Math.max(perFile[file].most, path.line[endRow(path, i)]);
  });
  const tables = perFile.map(({ most, count }) => ({
    first: new Uint32Array(most + 2), rows: new Uint32Array(count),
  }));
  each(path, (i, file) => { tables[file].first[path.line[endRow(path, i)] + 1]++; });
  for (const { first } of tables) for (let n = 1; n < first.length; n++) first[n] += first[n - 1];
  const next = tables.map(({ first }) => first.slice());
  each(path, (i, file) => { tables[file].rows[next[file][path.line[endRow(path, i)]]++] = i; });
  return tables;
}

/** The moves of a line of a file, in order; empty where it made none. */
export function runsOf(path, tables, file, line) {
  const table = tables[path.files.indexOf(file)];
  if (!table || line < 0 || line + 1 >= table.first.length) return new Uint32Array(0);
  return table.rows.subarray(table.first[line], table.first[line + 1]);
}

function each(path, handler) {
  for (let s = 0, move = 0; s < path.stretches; s++) {
    const stop = s + 1 < path.stretches ? path.stretch_first[s + 1] : path.rows;
    for (; move < path.moves && endRow(path, move) < stop; move++) handler(move, path.stretch_file[s]);
  }
}
