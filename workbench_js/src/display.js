// The right of the page: what an operator's display shows, and the layers behind it.

import { button, el, fill, shown } from "./dom.js";
import { goTo, on, runIndex, selectRow, stepRun, store } from "./store.js";

const SYSTEMS = [["pcs", "PCS", "programmed"], ["wcs", "WCS", "workpiece"], ["mcs", "MCS", "machine, tool tip"], ["acs", "ACS", "axes"]];
const MOST_RUNS = 500;

export class Display {
  constructor(host) {
    host.classList.add("nc-display");
    this.host = host;
    this.head = el("div", { class: "nc-display-head" });
    this.runs = el("div", { class: "nc-runs" });
    this.body = el("div", { class: "nc-display-body" });
    host.append(this.head, this.runs, this.body);
    this.ends = [on("block", () => this.showBlock()), on("place", () => this.showRuns()), on("cursor", () => this.showRuns())];
    this.showBlock();
  }

  showBlock() {
    const { block } = store;
    if (!block) {
      fill(this.head, el("span", { class: "nc-quiet" }, store.place ? `${store.place.file}:${store.place.line} was not executed` : "no block is chosen"));
      fill(this.body);
      return;
    }
    const { move, explanation } = block;
    const number = explanation.block === null ? "" : ` N${explanation.block}`;
    const motion = move ? `${move.motion}${move.feed === null ? "" : ` F${shown(move.feed, 0)}`}` : "no motion";
    fill(this.head,
      el("button", { type: "button", class: "nc-link", onclick: () => goTo(explanation.file, explanation.line) }, `${explanation.file}:${explanation.line}${number}`),
      el("span", { class: "nc-motion" }, motion),
      move && el("span", { class: "nc-quiet" }, `move ${move.index + 1} of ${store.result?.moves ?? ""}`),
    );
    fill(this.body, move && positions(move), move && directionOf(move), layers(explanation));
    this.showRuns();
  }

  showRuns() {
    const count = store.runs.length, at = runIndex();
    this.runs.classList.toggle("nc-hidden", count < 2);
    if (count < 2) return;
    const list = el("select", { class: "nc-select", "aria-label": "run of the line", onchange: () => selectRow(Number(list.value), "run") });
    const first = Math.max(0, Math.min(at - MOST_RUNS / 2, count - MOST_RUNS));
    for (let i = first; i < Math.min(count, first + MOST_RUNS); i++) {
      list.append(el("option", { value: store.runs[i], selected: i === at }, `run ${i + 1}`));
    }
    fill(this.runs, el("span", {}, `ran ${count} times`), button("‹", "previous run (PageUp)", () => stepRun(-1)), list, button("›", "next run (PageDown)", () => stepRun(1)));
  }

  dispose() { for (const end of this.ends) end(); }
}

function positions(move) {
  const axes = Object.keys(move.acs);
  return el("table", { class: "nc-numbers nc-positions" },
    el("thead", {}, el("tr", {}, el("th"), SYSTEMS.map(([, name, meaning]) => el("th", { title: meaning }, name)))),
    el("tbody", {}, axes.map((axis) => el("tr", {}, el("th", {}, axis), SYSTEMS.map(([system]) =>
      el("td", { "data-system": system, "data-axis": axis, "data-value": move[system][axis] ?? "" }, shown(move[system][axis])),
    )))),
  );
}

function directionOf(move) {
  if (!move.direction) return null;
  return el("div", { class: "nc-direction" }, "tool direction ", move.direction.map((v) => el("span", { class: "nc-value" }, shown(v))));
}

function layers(explanation) {
  const axes = Object.keys(explanation.layers[0].values);
  return [el("h3", {}, "Where it comes from"), el("table", { class: "nc-numbers nc-layers" },
    el("thead", {}, el("tr", {}, el("th", {}, "layer"), axes.map((a) => el("th", {}, a)))),
    el("tbody", {}, explanation.layers.flatMap((layer) => layerRows(layer, axes))),
  )];
}

/** What a layer adds, and below it the value behind it; a layer that adds nothing has one row. */
function layerRows(layer, axes) {
  const ends = layer.name === "programmed" || layer.name === "axes";
  const adds = axes.some((a) => Math.abs(layer.change[a]) > 5e-10);
  const rows = [];
  if (!ends) {
    rows.push(el("tr", { class: "nc-change" }, el("th", {}, layer.name, el("span", { class: "nc-origins" }, origins(layer.origin))), axes.map((a) => el("td", {}, change(layer.change[a])))));
  }
  if (ends || adds) {
    rows.push(el("tr", { class: ends ? "nc-end" : "nc-after" }, el("th", {}, ends ? layer.name : ""), axes.map((a) => el("td", {}, shown(layer.values[a])))));
  }
  return rows;
}

const change = (value) => (Math.abs(value) <= 5e-10 ? "" : `${value > 0 ? "+" : ""}${shown(value)}`);

/** `file:line` places as buttons that go there. */
function origins(origin) {
  if (!origin) return null;
  return origin.split(", ").map((place) => {
    const [, file, line] = place.match(/^(.*):(\d+)$/) ?? [];
    if (!file) return el("span", {}, place);
    return el("button", { type: "button", class: "nc-link", title: `go to ${place}`, onclick: () => goTo(file, Number(line)) }, place);
  });
}

