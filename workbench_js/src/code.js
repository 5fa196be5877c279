// The left of the page: program, subprograms and lists in tabs.

import { button, el, fill } from "./dom.js";
import { Editor } from "./editor.js";
import { mainName, on, selectLine, store } from "./store.js";

/** Key of a file that a result names. */
const keyOf = (name) => store.result?.files[name]?.[0];

const LONGEST_WAIT = 1500;

/** A large text comes behind the picture of its path, unless that takes long. */
function firstPicture() {
  if (store.revision) return Promise.resolve();
  return new Promise((done) => {
    const end = on("result", () => { end(); requestAnimationFrame(() => setTimeout(done)); });
    setTimeout(done, LONGEST_WAIT);
  });
}

export class Code {
  constructor(host) {
    this.host = host;
    host.classList.add("nc-code");
    this.tabs = el("div", { class: "nc-file-tabs", role: "tablist" });
    this.saveButton = button("save", "save this file (Ctrl+S)", () => this.shown?.save());
    this.texts = el("div", { class: "nc-texts" });
    host.append(el("div", { class: "nc-file-bar" }, this.tabs, this.saveButton), this.texts);
    this.editors = new Map();
    this.ends = [
      on("state", () => this.takeProgram()),
      on("result", () => { this.showTabs(); this.showDiagnostics(); this.showPlace("result"); }),
      on("place", (by) => this.showPlace(by)),
      on("open", ({ file, line }) => this.goTo(file, line)),
    ];
    window.addEventListener("beforeunload", this.leave);
    this.takeProgram();
  }

  leave = (event) => {
    if ([...this.editors.values()].some((editor) => editor.changed)) event.preventDefault();
  };

  /** Files that can be shown: the program first, then what the run has read. */
  files() {
    const { program } = store.state;
    if (!program) return [];
    const found = [{ key: program, name: mainName(), kind: "program" }];
    for (const [name, [key, kind]] of Object.entries(store.result?.files ?? {})) {
      if (key !== program) found.push({ key, name, kind });
    }
    return found;
  }

  takeProgram() {
    const { program } = store.state;
    if (!program || program === this.program) return;
    this.program = program;
    this.showTabs();
    this.show(program);
  }

  showTabs() {
    fill(this.tabs, this.files().map(({ key, name, kind }) => {
      const bad = (store.result?.diagnostics ?? []).some((d) => d.file === name && d.error);
      const changed = this.editors.get(key)?.changed;
      return el("button", {
        type: "button", role: "tab", title: `${kind}: ${key}`, "aria-selected": key === this.current,
        class: `nc-file-tab ${key === this.current ? "nc-chosen" : ""} ${bad ? "nc-bad" : ""}`,
        onclick: () => this.show(key),
      }, changed ? `${name} *` : name);
    }));
    this.saveButton.disabled = !this.shown?.changed;
  }

  get shown() { return this.editors.get(this.current); }

  async show(key) {
    const file = this.files().find((f) => f.key === key);
    if (!file) return null;
    this.current = key;
    let editor = this.editors.get(key);
    if (!editor) {
      editor = new Editor(file, {
        lineChosen: (line) => { if (file.kind !== "list") selectLine(file.name, line, "code"); },
        changed: () => this.showTabs(),
        trouble: (text) => this.trouble(text),
      });
      editor.host = el("div", { class: "nc-text" });
      this.editors.set(key, editor);
      this.texts.append(editor.host);
      editor.ready = firstPicture().then(() => editor.open(editor.host)).catch((error) => {
        this.editors.delete(key);
        editor.host.remove();
        this.trouble(error.message);
      });
    }
    this.showTabs();
    for (const [other, { host }] of this.editors) host.classList.toggle("nc-hidden", other !== key);
    await editor.ready;
    this.showDiagnostics();
    this.showPlace("tab");
    return editor;
  }

  showDiagnostics() {
    for (const editor of this.editors.values()) {
      const own = (d) => d.line && d.file === editor.file.name && keyOf(d.file) === editor.file.key;
      editor.setDiagnostics((store.result?.diagnostics ?? []).filter(own));
    }
    this.showTabs();
  }

  showPlace(by) {
    const { place } = store;
    if (!place) return;
    const editor = [...this.editors.values()].find((e) => e.file.key === keyOf(place.file));
    if (!editor) return;
    if (by === "result" && editor.view?.hasFocus) return;
    if (["scene", "run", "step", "timeline"].includes(by) && editor !== this.shown) this.show(editor.file.key);
    if (editor === this.shown) editor.show(place.line);
  }

  async goTo(name, line) {
    const file = this.files().find((f) => f.name === name);
    const editor = file && await this.show(file.key);
    if (editor?.view) { editor.goTo(line); editor.show(line); }
  }

  trouble(text) {
    const bar = el("div", { class: "nc-trouble", role: "alert" }, text, button("close", "close", () => bar.remove()));
    this.host.append(bar);
  }

  dispose() {
    window.removeEventListener("beforeunload", this.leave);
    for (const end of this.ends) end();
    for (const editor of this.editors.values()) editor.dispose();
  }
}

