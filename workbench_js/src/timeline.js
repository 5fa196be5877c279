// The bottom of the page: playback, scrubbing, and the curves of the axes over the blocks.

import { button, el, fill, oncePerFrame } from "./dom.js";
import { Curves } from "./curves.js";
import { timeAt } from "./path.js";
import { on, rowOf, setCursor, step, stopPlaying, store, togglePlaying } from "./store.js";

const SPEEDS = [0.1, 0.5, 1, 2, 5, 10, 50, 100, 1000];

export class Timeline {
  constructor(host) {
    host.classList.add("nc-timeline");
    this.play = button("▶", "play and pause (Space)", togglePlaying, "nc-play");
    this.slider = el("input", { type: "range", class: "nc-slider", min: 0, max: 1, step: "any", value: 0, "aria-label": "place on the path", oninput: () => {
      stopPlaying();
      setCursor(Number(this.slider.value), "timeline");
    } });
    this.where = el("span", { class: "nc-where" });
    this.speed = el("select", { class: "nc-select", "aria-label": "speed of the playback", onchange: () => { store.speed = Number(this.speed.value); } },
      SPEEDS.map((s) => el("option", { value: s, selected: s === store.speed }, `× ${s}`)));
    this.chart = el("div", { class: "nc-chart" });
    this.names = el("div", { class: "nc-axis-names" });
    host.append(el("div", { class: "nc-transport" },
      button("|◀", "first block (Home)", () => { stopPlaying(); setCursor(1, "step"); }), button("◂", "previous block (Left)", () => step(-1)), this.play,
      button("▸", "next block (Right)", () => step(1)), button("▶|", "last block (End)", () => { stopPlaying(); setCursor(Infinity, "step"); }),
      this.speed, this.slider, this.where,
    ), el("div", { class: "nc-curves" }, this.names, this.chart));
    this.curves = new Curves(this.chart, this.names);
    this.show = oncePerFrame(() => this.showCursor());
    this.ends = [
      on("result", () => { this.slider.max = store.path.moves; this.curves.take(); this.show(); }),
      on("cursor", this.show), on("playing", this.show),
    ];
    if (store.revision) { this.slider.max = store.path.moves; this.curves.take(); }
    this.showCursor();
  }

  showCursor() {
    const { path, cursor, playing } = store;
    this.play.textContent = playing ? "❚❚" : "▶";
    if (document.activeElement !== this.slider || playing) this.slider.value = cursor;
    fill(this.where, path.moves ? `block ${rowOf(cursor) + 1} / ${path.moves}   ≈ ${clock(timeAt(path, cursor))}` : "");
    this.curves.moveCursor(cursor);
  }

  dispose() {
    for (const end of this.ends) end();
    this.curves.dispose();
  }
}

function clock(seconds) {
  const minutes = Math.floor(seconds / 60);
  return `${minutes}:${(seconds - 60 * minutes).toFixed(1).padStart(4, "0")}`;
}
