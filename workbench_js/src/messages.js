// What the run said: messages of the program, and diagnostics, each a way to its place.

import { el, fill } from "./dom.js";
import { goTo, on, store } from "./store.js";

const MOST = 500;

export class Messages {
  constructor(host) {
    host.classList.add("nc-messages");
    this.list = el("div", { class: "nc-message-list" });
    host.append(this.list);
    this.ends = [on("result", () => this.show()), on("trouble", (text) => this.show(text))];
    this.show();
  }

  show(trouble) {
    const { diagnostics = [], messages = [] } = store.result ?? {};
    const rows = [
      ...(trouble ? [row("error", "", "", trouble)] : []),
      ...diagnostics.slice(0, MOST).map(diagnosticRow),
      ...messages.slice(0, MOST).map(messageRow),
    ];
    const hidden = diagnostics.length + messages.length - rows.length;
    if (hidden > 0) rows.push(row("note", "", "", `${hidden} more are not shown`));
    fill(this.list, rows.length ? rows : el("div", { class: "nc-empty" }, "nothing to say"));
  }

  dispose() { for (const end of this.ends) end(); }
}

function diagnosticRow(d) {
  const place = d.line ? `${d.file}:${d.line}:${d.column}` : d.file ?? "";
  return el("button", {
    type: "button", class: `nc-message nc-${d.severity}`, onclick: () => d.line && goTo(d.file, d.line),
  }, el("span", { class: "nc-severity" }, d.severity), el("span", { class: "nc-id" }, d.id), el("span", { class: "nc-place" }, place),
  el("span", { class: "nc-text-of" }, d.message, d.hint && el("span", { class: "nc-hint" }, d.hint)));
}

function messageRow({ source, line, text, file }) {
  if (!line) return row("message", file ?? "", "", text);
  return el("button", { type: "button", class: "nc-message", onclick: () => goTo(source, line) },
    el("span", { class: "nc-severity" }, "message"), el("span", { class: "nc-id" }), el("span", { class: "nc-place" }, `${source}:${line}`), el("span", { class: "nc-text-of" }, text));
}

function row(kind, place, id, text) {
  return el("div", { class: `nc-message nc-${kind}` }, el("span", { class: "nc-severity" }, kind), el("span", { class: "nc-id" }, id),
    el("span", { class: "nc-place" }, place), el("span", { class: "nc-text-of" }, text));
}
