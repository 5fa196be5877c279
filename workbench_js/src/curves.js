// Axis positions over the blocks, reduced to what the pixels can show; limits as lines.

import uPlot from "uplot";
import { AXIS_COLOURS, colour, el, fill, onTheme } from "./dom.js";
import { envelope } from "./decimate.js";
import { cursorOfRows, endRow, stretchOf } from "./path.js";
import { setCursor, stopPlaying, store } from "./store.js";

const POLE = "pole distance";

/** Values for uPlot, where a gap is null and not NaN. */
function gaps(values) {
  return values.some((v) => v !== v) ? Array.from(values, (v) => (v === v ? v : null)) : values;
}

/** Neighbouring rows as [first, last]. */
function joined(rows) {
  const found = [];
  for (const row of rows) {
    if (found.length && found.at(-1)[1] === row - 1) found.at(-1)[1] = row; else found.push([row, row]);
  }
  return found;
}

export class Curves {
  constructor(host, names) {
    this.host = host;
    this.names = names;
    this.hidden = new Set();
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(host);
    this.endTheme = onTheme(() => this.take());
    this.line = el("div", { class: "nc-cursor-line" });
  }

  /** Another path. */
  take() {
    const { path } = store;
    this.from = 0;
    this.to = path.moves;
    this.hasPole = path.moves > 0 && path.pole.some((v) => v === v);
    this.plot?.destroy();
    this.plot = null;
    this.showNames();
    if (!path.moves || !this.host.clientWidth) return;
    this.plot = new uPlot(this.options(), this.data(), this.host);
    this.plot.over.append(this.line);
    this.moveCursor(store.cursor);
  }

  showNames() {
    const machine = store.result?.machine.axes ?? [];
    fill(this.names, store.path.axisNames.map((name, i) => el("label", { class: "nc-axis-name" },
      el("input", { type: "checkbox", checked: !this.hidden.has(name), onchange: (event) => {
        if (event.target.checked) this.hidden.delete(name); else this.hidden.add(name);
        this.take();
      } }),
      el("i", { style: `background:${AXIS_COLOURS[i % AXIS_COLOURS.length]}` }), name,
      machine.find((a) => a.name === name)?.rotary ? el("span", { class: "nc-quiet" }, "°") : null,
    )), this.hasPole ? this.poleName() : null);
  }

  poleName() {
    return el("label", { class: "nc-axis-name", title: "degrees between the tool and its singular direction" },
      el("input", { type: "checkbox", checked: !this.hidden.has(POLE), onchange: (event) => {
        if (event.target.checked) this.hidden.delete(POLE); else this.hidden.add(POLE);
        this.take();
      } }), el("i", { class: "nc-dashed" }), "pole");
  }

  isRotary(name) { return store.result?.machine.axes.find((a) => a.name === name)?.rotary ?? /^[ABC]/.test(name); }

  options() {
    const text = colour("quiet"), grid = { stroke: colour("line"), width: 1 };
    const axis = (scale, side, unit) => ({
      scale, side, stroke: text, grid: side === 3 ? grid : { show: false }, ticks: grid, size: 56,
      font: "11px system-ui, sans-serif", values: (_, ticks) => ticks.map((v) => `${v}${unit}`),
    });
    const series = store.path.axisNames.map((name, i) => ({
      label: name, scale: this.isRotary(name) ? "deg" : "mm", stroke: AXIS_COLOURS[i % AXIS_COLOURS.length],
      width: 1.25, points: { show: false }, show: !this.hidden.has(name),
    }));
    if (this.hasPole) {
      series.push({ label: POLE, scale: "deg", stroke: colour("quiet"), width: 1, dash: [3, 3], points: { show: false }, show: !this.hidden.has(POLE) });
    }
    const used = new Set(series.filter((s) => s.show).map((s) => s.scale));
    return {
      width: this.host.clientWidth, height: Math.max(60, this.host.clientHeight), legend: { show: false },
      cursor: { drag: { x: true, y: false, setScale: false }, points: { show: false }, y: false },
      scales: { x: { time: false, range: () => [this.from, this.to] }, mm: {}, deg: {} },
      series: [{}, ...series],
      axes: [
        { stroke: text, grid, ticks: grid, font: "11px system-ui, sans-serif", size: 28 },
        ...(used.has("mm") ? [axis("mm", 3, "")] : []), ...(used.has("deg") ? [axis("deg", 1, "°")] : []),
      ],
      hooks: { ready: [(plot) => this.watch(plot)], drawClear: [(plot) => this.drawEvents(plot)], draw: [(plot) => this.drawLimits(plot)] },
    };
  }

  /** One common x for all curves: uPlot wants aligned columns. */
  data() {
    const { path } = store, n = path.axisNames.length;
    const pixels = Math.max(50, this.host.clientWidth - 100);
    let stretch = 0;
    const rowIn = (at) => {
      const i = at - 1;  // point 0 is the start of the path, point n the end of its n-th move
      if (i < 0) return 0;
      if (path.stretch_first[stretch] > i || (stretch + 1 < path.stretches && path.stretch_first[stretch + 1] <= i)) stretch = stretchOf(path, i);
      return i + stretch + 1;
    };
    const from = this.rowsBefore(this.from), to = this.rowsBefore(this.to) + 1;
    let x = null;
    const columns = path.axisNames.map((_, column) => {
      const [own, y] = envelope(path.axes, n, column, rowIn, from, to, pixels);
      x ??= path.ends ? own.map((rows) => cursorOfRows(path, rows)) : own;
      return y;
    });
    if (this.hasPole) columns.push(envelope(path.pole, 1, 0, (i) => Math.max(0, i - 1), from, to, pixels)[1]);
    return [x, ...columns.map(gaps)];
  }

  /** Rows of the path before a number of moves is done. */
  rowsBefore(moves) { return moves ? endRow(store.path, Math.min(store.path.moves, moves) - 1) + 1 : 0; }

  watch(plot) {
    const at = (event) => plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x");
    let down = null;
    plot.over.addEventListener("pointerdown", (event) => { down = at(event); });
    plot.over.addEventListener("pointerup", (event) => {
      const up = at(event);
      if (down === null) return;
      if (Math.abs(plot.valToPos(up, "x") - plot.valToPos(down, "x")) < 4) {
        stopPlaying();
        setCursor(Math.max(1, Math.round(up)), "timeline");
      } else this.zoom(Math.min(up, down), Math.max(up, down));
      down = null;
    });
    plot.over.addEventListener("dblclick", () => this.zoom(0, store.path.moves));
    plot.over.addEventListener("wheel", (event) => {
      event.preventDefault();
      const middle = at(event), factor = event.deltaY > 0 ? 1.3 : 1 / 1.3;
      this.zoom(middle - (middle - this.from) * factor, middle + (this.to - middle) * factor);
    }, { passive: false });
  }

  zoom(from, to) {
    const { moves } = store.path;
    this.from = Math.max(0, Math.floor(from));
    this.to = Math.min(moves, Math.max(this.from + Math.min(moves, 4), Math.ceil(to)));
    this.plot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    this.plot.setData(this.data());
    this.moveCursor(store.cursor);
  }

  /** Travel limits of the axes that are shown. */
  drawLimits(plot) {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.setLineDash([5, 4]);
    ctx.lineWidth = 1.25 * devicePixelRatio;
    store.path.axisNames.forEach((name, i) => {
      const limits = store.result?.machine.axes.find((a) => a.name === name)?.limits;
      if (!limits || this.hidden.has(name)) return;
      ctx.strokeStyle = AXIS_COLOURS[i % AXIS_COLOURS.length];
      for (const limit of limits) {
        const y = plot.valToPos(limit, this.isRotary(name) ? "deg" : "mm", true);
        if (!(y >= bbox.top && y <= bbox.top + bbox.height)) continue;
        ctx.beginPath();
        ctx.moveTo(bbox.left, y);
        ctx.lineTo(bbox.left + bbox.width, y);
        ctx.stroke();
      }
    });
    ctx.restore();
  }

  /** Bands behind the curves: blocks beyond a travel limit, swings at the pole, turned-over axes. */
  drawEvents(plot) {
    const { ctx, bbox } = plot, { limits = [], swings = [], wraps = [], poses = [] } = store.result?.events ?? {};
    const bands = (shade, rows) => {
      ctx.fillStyle = shade;
      for (const [first, last] of rows) {
        if (last + 1 < this.from || first > this.to) continue;
        const left = Math.max(bbox.left, plot.valToPos(first, "x", true)), right = Math.min(bbox.left + bbox.width, plot.valToPos(last + 1, "x", true));
        ctx.fillRect(left, bbox.top, Math.max(2, right - left), bbox.height);
      }
    };
    ctx.save();
    bands(colour("band-limit"), limits.flatMap(({ rows }) => joined(rows)));
    ctx.strokeStyle = colour("warning");
    ctx.setLineDash([2, 3]);
    for (const move of poses.filter((p) => p + 1 >= this.from && p + 1 <= this.to)) {
      const x = plot.valToPos(move + 1, "x", true);
      ctx.beginPath();
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
      ctx.stroke();
    }
    bands(colour("band-pole"), [...swings.map((s) => [s.row, s.last]), ...wraps.map((w) => [w.row, w.row])]);
    ctx.restore();
  }

  moveCursor(cursor) {
    if (!this.plot) return;
    const x = this.plot.valToPos(cursor, "x");
    this.line.style.transform = `translateX(${x}px)`;
    this.line.classList.toggle("nc-hidden", !(x >= 0 && x <= this.plot.over.clientWidth));
  }

  resize() {
    if (!this.plot) { if (store.path.moves) this.take(); return; }
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width && height) { this.plot.setSize({ width, height }); this.plot.setData(this.data()); this.moveCursor(store.cursor); }
  }

  dispose() {
    this.observer.disconnect();
    this.endTheme();
    this.plot?.destroy();
  }
}
