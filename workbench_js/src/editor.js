// One text in an editor: edits go to the server as change sets, diagnostics stand at their lines.

import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { EditorSelection, EditorState, StateEffect, StateField, Transaction } from "@codemirror/state";
import {
  Decoration, drawSelection, EditorView, highlightActiveLineGutter, keymap, lineNumbers,
} from "@codemirror/view";
import { askText, tell } from "./api.js";
import { codeColours } from "./code_colours.js";

const PAUSE = 300;
const MOST_SHOWN = 1000;

const setMark = StateEffect.define();
const markedLine = StateField.define({
  create: () => Decoration.none,
  update(marks, transaction) {
    marks = marks.map(transaction.changes);
    for (const effect of transaction.effects) {
      if (effect.is(setMark)) marks = effect.value === null ? Decoration.none : Decoration.set([LINE.range(effect.value)]);
    }
    return marks;
  },
  provide: (field) => EditorView.decorations.from(field),
});
const LINE = Decoration.line({ class: "nc-current-line" });

/** Characters that the control's files cannot hold become a question mark. */
const latin1 = EditorState.transactionFilter.of((transaction) => {
  if (!transaction.docChanged) return transaction;
  let foreign = false;
  transaction.changes.iterChanges((a, b, c, d, text) => { foreign ||= /[^\u0000-\u00ff]/.test(text.toString()); });
  if (!foreign) return transaction;
  const changes = [];
  transaction.changes.iterChanges((from, to, c, d, text) => {
    changes.push({ from, to, insert: text.toString().replace(/[^\u0000-\u00ff]+/gu, "?") });
  });
  return { changes, userEvent: transaction.annotation(Transaction.userEvent) };
});

export class Editor {
  /** file: {key, name, kind}. told: lineChosen(line), changed(editor), trouble(text). */
  constructor(file, told) {
    this.file = file;
    this.told = told;
    this.pending = null;
    this.sending = false;
    this.changed = false;
    this.version = 0;
    this.quiet = false;
  }

  async open(host) {
    const { text, version, changed } = await askText(this.file.key);
    this.version = version;
    this.changed = changed;
    this.view = new EditorView({ parent: host, state: this.state(text) });
    this.told.changed(this);
  }

  state(text) {
    const odd = text.includes("\r");
    return EditorState.create({
      doc: text,
      extensions: [
        odd ? EditorState.lineSeparator.of("\n") : [],
        lineNumbers(), highlightActiveLineGutter(), history(), drawSelection(), search({ top: true }),
        highlightSelectionMatches(), lintGutter(), markedLine, latin1, codeColours(this.file.kind === "list"),
        keymap.of([
          { key: "Mod-s", run: () => { this.save(); return true; } },
          ...searchKeymap, ...historyKeymap, indentWithTab, ...defaultKeymap,
        ]),
        EditorView.updateListener.of((update) => this.updated(update)),
        EditorView.contentAttributes.of({ "aria-label": `text of ${this.file.name}`, spellcheck: "false" }),
      ],
    });
  }

  updated(update) {
    if (update.docChanged && !this.quiet) {
      this.pending = this.pending ? this.pending.compose(update.changes) : update.changes;
      this.changed = true;
      this.told.changed(this);
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.send(), PAUSE);
    } else if (update.selectionSet && !this.quiet && update.transactions.some((t) => t.isUserEvent("select"))) {
      this.told.lineChosen(update.state.doc.lineAt(update.state.selection.main.head).number);
    }
  }

  async send() {
    if (!this.pending || this.sending) return;
    this.sending = true;
    const changes = [];
    this.pending.iterChanges((from, to, a, b, text) => changes.push([from, to, text.toString()]));
    this.pending = null;
    try {
      this.took(await tell(this.address("edit"), { version: this.version, changes }));
    } catch (error) {
      await this.resend(error);
    }
    this.sending = false;
    if (this.pending) this.send();
  }

  /** After a fault the whole text is sent, so that both sides have the same one again. */
  async resend(fault) {
    try {
      this.pending = null;
      this.took(await tell(this.address("edit"), { text: this.view.state.doc.toString() }));
    } catch {
      this.told.trouble(fault.message);
    }
  }

  took({ version, changed }) {
    this.version = version;
    this.changed = changed || this.pending !== null;
    this.told.changed(this);
  }

  address(verb) { return `/${verb}?key=${encodeURIComponent(this.file.key)}`; }

  async save() {
    clearTimeout(this.timer);
    await this.send();
    try {
      this.took(await tell(this.address("save")));
    } catch (error) {
      this.told.trouble(error.message);
    }
  }

  /** Marks a line; shows it in the middle when it is out of sight. */
  show(line) {
    if (!this.view) return;
    const { doc } = this.view.state;
    const at = line >= 1 && line <= doc.lines ? doc.line(line).from : null;
    const effects = [setMark.of(at)];
    if (at !== null && !this.sees(at)) effects.push(EditorView.scrollIntoView(at, { y: "center" }));
    this.view.dispatch({ effects });
  }

  sees(at) {
    const box = this.view.scrollDOM.getBoundingClientRect(), place = this.view.coordsAtPos(at);
    return place !== null && place.top > box.top && place.bottom < box.bottom;
  }

  /** Puts the text cursor into a line without choosing it. */
  goTo(line) {
    const { doc } = this.view.state;
    const at = doc.line(Math.min(doc.lines, Math.max(1, line))).from;
    this.view.dispatch({ selection: EditorSelection.cursor(at), effects: EditorView.scrollIntoView(at, { y: "center" }) });
  }

  setDiagnostics(found) {
    if (!this.view) return;
    const { doc } = this.view.state;
    const items = found.slice(0, MOST_SHOWN).filter((d) => d.line <= doc.lines).map((d) => {
      const line = doc.line(d.line);
      const from = Math.min(line.to, line.from + d.column - 1);
      return {
        from, to: Math.min(doc.length, Math.max(from, Math.min(from + d.length, line.to))),
        severity: { error: "error", warning: "warning", note: "info" }[d.severity],
        source: d.id, message: d.hint ? `${d.message}\n${d.hint}` : d.message,
      };
    });
    this.view.dispatch(setDiagnostics(this.view.state, items));
  }

  dispose() {
    clearTimeout(this.timer);
    this.view?.destroy();
  }
}
