// What all parts of the page share: the result, and one selection. Parts talk only through it.

import { ask, askBytes, Refused, useSession } from "./api.js";
import { cursorAt, EMPTY, endRow, runsOf, runsOfLines, stretchOf, timeAt, unpack } from "./path.js";

const listeners = new Map();

/** Names: state, loading, result, cursor, block, place, jog, playing. Returns the way to end it. */
export function on(name, handler) {
  if (!listeners.has(name)) listeners.set(name, new Set());
  listeners.get(name).add(handler);
  return () => listeners.get(name).delete(handler);
}

function emit(name, detail) {
  for (const handler of listeners.get(name) ?? []) handler(detail);
}

/** cursor: place on the path, n is the end of the n-th move. place: file and line that is shown.
    runs: all moves of this line. block: the server's numbers of the move, see moves.py.
    jog: axis positions by name that the machine shows instead of the path, or null. */
export const store = {
  state: { program: "", machine: "", revision: 0, running: false, progress: 0, problem: "" },
  revision: 0, result: null, path: EMPTY, runTables: [],
  cursor: 0, place: null, runs: new Uint32Array(0), block: null, playing: false, speed: 1,
  jog: null, firstPath: 0,
};

export function startSession(key) {
  useSession(key);
}

// --- results -----------------------------------------------------------------------------------

let loading = null;

/** Takes the state that the server sent; loads the result when there is a new one. */
export function receiveState(state) {
  const other = state.program !== store.state.program || state.machine !== store.state.machine;
  store.state = { ...state };
  if (other) rememberInAddress(state);
  emit("state");
  if (state.revision !== store.revision) load(state.revision);
}

function rememberInAddress({ program, machine }) {
  const address = new URL(window.location.href);
  address.searchParams.set("program", program);
  address.searchParams.set("machine", machine);
  history.replaceState(null, "", address);
}

async function load(revision) {
  loading?.abort();
  loading = new AbortController();
  const { signal } = loading;
  try {
    const [result, bytes] = await Promise.all([
      ask(`/result/${revision}`, signal), askBytes(`/path/${revision}`, signal),
    ]);
    if (signal.aborted) return;
    take(revision, result, unpack(bytes));
  } catch (error) {
    if (error.name !== "AbortError" && error.status !== 404) emit("trouble", String(error.message));
  }
}

function take(revision, result, path) {
  const sameProgram = store.result?.program === store.state.program;
  store.revision = revision;
  store.result = { ...result, program: store.state.program };
  store.path = path;
  store.runTables = runsOfLines(path);
  store.firstPath ||= performance.now();
  const cursor = sameProgram ? Math.min(store.cursor, path.moves) : Math.min(1, path.moves);
  emit("result", { sameProgram });
  setCursor(cursor, "result");
}

// --- the selection -----------------------------------------------------------------------------

/** The move that the cursor is in, -1 before there is a path. */
export const rowOf = (cursor) => Math.min(store.path.moves, Math.max(1, Math.ceil(cursor))) - 1;

/** Puts the cursor on the path; everything else follows. by: who did it, so that it need not move. */
export function setCursor(cursor, by = "") {
  const { path } = store;
  store.cursor = Math.min(path.moves, Math.max(0, cursor));
  if (store.jog) { store.jog = null; emit("jog"); }
  const row = rowOf(store.cursor);
  const place = row >= 0 ? placeOf(row) : null;
  const moved = place?.file !== store.place?.file || place?.line !== store.place?.line;
  if (moved || by === "result") {
    store.place = place;
    store.runs = place ? runsOf(path, store.runTables, place.file, place.line) : new Uint32Array(0);
    emit("place", by);
  }
  emit("cursor", by);
  askBlock(row);
}

export function selectRow(row, by = "") { setCursor(row + 1, by); }

/** A line was chosen: its first move, or the line alone where it made none. */
export function selectLine(file, line, by = "") {
  stopPlaying();
  const runs = runsOf(store.path, store.runTables, file, line);
  if (runs.length) {
    const row = rowOf(store.cursor);
    if (runs.includes(row)) { store.place = { file, line }; emit("place", by); askBlock(row); } else selectRow(runs[0], by);
    return;
  }
  store.place = { file, line };
  store.runs = runs;
  emit("place", by);
  askLine(file, line);
}

/** File and line of a move. */
export function placeOf(row) {
  const { path } = store, end = endRow(path, row);
  return { file: path.files[path.stretch_file[stretchOf(path, end)]], line: path.line[end] };
}

/** Goes to `file:line`, as origins and diagnostics name it, in the editor and on the path. */
export function goTo(file, line) {
  emit("open", { file, line });
  if (store.result?.files[file]?.[1] !== "list") selectLine(file, line, "link");
}

export function step(by) {
  stopPlaying();
  const { cursor } = store;
  setCursor(by > 0 ? Math.floor(cursor + 1e-9) + by : Math.max(1, Math.ceil(cursor - 1e-9) + by), "step");
}

/** Another run of the line that is shown. */
export function stepRun(by) {
  const at = runIndex();
  if (at >= 0 && at + by >= 0 && at + by < store.runs.length) selectRow(store.runs[at + by], "run");
}

/** Place of the current move among the runs of its line, -1 when it is none of them. */
export function runIndex() {
  const { runs } = store, row = rowOf(store.cursor);
  let low = 0, high = runs.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (runs[middle] < row) low = middle + 1; else high = middle;
  }
  return runs[low] === row ? low : -1;
}

// --- the server's numbers ----------------------------------------------------------------------

let wanted = null, asking = false;

/** The numbers of a move; while it plays the newest question waits for the answer before it. */
function askBlock(row) {
  wanted = row >= 0 ? `/move/${store.revision}/${row}` : null;
  if (!asking) askNext();
}

function askLine(file, line) {
  wanted = file === mainName() ? `/line/${store.revision}/${line}` : null;
  if (wanted === null) { store.block = null; emit("block"); }
  if (!asking) askNext();
}

export const mainName = () => store.state.program.split("/").pop();

async function askNext() {
  asking = true;
  while (wanted !== null) {
    const question = wanted;
    wanted = null;
    try {
      store.block = await ask(question);
    } catch (error) {
      if (error instanceof Refused && question.startsWith("/line")) store.block = null;
    }
    if (wanted === null || store.playing) emit("block");
    if (store.playing) await new Promise((done) => setTimeout(done, 200));
  }
  asking = false;
}

// --- playback ----------------------------------------------------------------------------------

let lastFrame = 0;

export function play() {
  if (!store.path.moves) return;
  if (store.cursor >= store.path.moves) setCursor(0, "play");
  store.playing = true;
  lastFrame = performance.now();
  emit("playing");
  requestAnimationFrame(frame);
}

export function stopPlaying() {
  if (!store.playing) return;
  store.playing = false;
  emit("playing");
  askBlock(rowOf(store.cursor));
}

export const togglePlaying = () => (store.playing ? stopPlaying() : play());

function frame(now) {
  if (!store.playing) return;
  const time = timeAt(store.path, store.cursor) + ((now - lastFrame) / 1000) * store.speed;
  lastFrame = now;
  setCursor(cursorAt(store.path, time), "play");
  if (store.cursor >= store.path.moves) stopPlaying();
  else requestAnimationFrame(frame);
}

// --- jogging -----------------------------------------------------------------------------------

/** Axis positions by name that the machine shows, tool length beside them; null: the path again. */
export function setJog(jog) {
  stopPlaying();
  store.jog = jog;
  emit("jog");
}
