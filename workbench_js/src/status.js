// The state of the run in the header, and the way to stop it.

import { tell } from "./api.js";
import { button, el, fill } from "./dom.js";
import { on, store } from "./store.js";

export class Status {
  constructor(host) {
    this.text = el("span", { class: "nc-status-text", role: "status" });
    this.stop = button("stop", "stop the run", () => tell("/stop"), "nc-stop");
    host.append(this.text, this.stop);
    this.ends = [on("state", () => this.show()), on("result", () => this.show())];
    this.show();
  }

  show() {
    const { state, result } = store;
    this.stop.classList.toggle("nc-hidden", !state.running);
    if (!state.program) fill(this.text, "choose a program");
    else if (state.running) fill(this.text, `running ${state.progress > 0.01 ? `${Math.round(100 * state.progress)} %` : "..."}`);
    else if (state.problem) fill(this.text, el("span", { class: "nc-bad" }, state.problem));
    else if (result && store.revision === state.revision) fill(this.text, summary(result));
    else fill(this.text, "loading ...");
  }

  dispose() { for (const end of this.ends) end(); }
}

function summary(result) {
  const count = (severity) => result.diagnostics.filter((d) => d.severity === severity).length;
  const errors = count("error"), warnings = count("warning");
  return [
    el("span", {}, `${result.moves.toLocaleString("en")} moves`),
    result.ok && !errors ? el("span", { class: "nc-good" }, "ok") : el("span", { class: "nc-bad" }, "stopped by an error"),
    errors ? el("span", { class: "nc-bad" }, `${errors} error${errors > 1 ? "s" : ""}`) : null,
    warnings ? el("span", { class: "nc-warn" }, `${warnings} warning${warnings > 1 ? "s" : ""}`) : null,
  ].filter(Boolean);
}
