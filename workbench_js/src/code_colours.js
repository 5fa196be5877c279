// Colours of NC programs and lists, for the lines that are on the screen only.

import { Decoration, ViewPlugin } from "@codemirror/view";

const NC = new RegExp([
  String.raw`(?<comment>\([^)\n]*\)?|;.*)`,
  String.raw`(?<text>"[^"\n]*"?)`,
  String.raw`(?<control>\$[A-Z]+)`,
  String.raw`(?<command>#[A-Z]+(?:[ \t]+(?:DEF|ON|OFF|ALL|ID|MODE|SELECT|ADD|SET|TRACK|AX|CMDPOS|ACTPOS|SAVE|ORI|CS|DATA|OFFSETS|TO|WCS|MCS|EX|TOOL)\b)*)`,
  String.raw`(?<variable>\b[VP]\.?[A-Z_.]*[A-Z0-9_.\[\]]*(?=[\s=\].+*/-]|$)|\bP\d+)`,
  String.raw`(?<number>^[ \t]*(?:/\d*[ \t]*)?N\d+)`,
  String.raw`(?<function>\b[GMLTDSHF]\d+(?:\.\d+)?|\bL[ \t]+CYCLE\b|\bLL?\b|%L?\b)`,
  String.raw`(?<axis>\b[A-Z]\d?(?==|[-+]?[.\d\[]))`,
].join("|"), "gi");
const LIST = new RegExp([
  String.raw`(?<comment>#.*|\([^)\n]*\)?|/\*.*?(?:\*/|$))`,
  String.raw`(?<key>^[ \t]*[A-Za-z_][\w.\[\]]*)`,
  String.raw`(?<value>[-+]?\b\d[\w.+-]*)`,
].join("|"), "g");

const MARKS = Object.fromEntries(
  ["comment", "text", "control", "command", "variable", "number", "function", "axis", "key", "value"]
    .map((name) => [name, Decoration.mark({ class: `nc-c-${name}` })]),
);
const LONGEST = 2000;

/** An extension that colours a program or a list. */
export function codeColours(isList) {
  const pattern = isList ? LIST : NC;
  const marks = (view) => {
    const found = [];
    for (const { from, to } of view.visibleRanges) {
      for (let at = from; at <= to;) {
        const line = view.state.doc.lineAt(at);
        for (const match of line.text.slice(0, LONGEST).matchAll(pattern)) {
          const name = Object.keys(match.groups).find((group) => match.groups[group] !== undefined);
          if (match[0]) found.push(MARKS[name].range(line.from + match.index, line.from + match.index + match[0].length));
        }
        at = line.to + 1;
      }
    }
    return Decoration.set(found);
  };
  return ViewPlugin.fromClass(class {
    constructor(view) { this.decorations = marks(view); }
    update(update) {
      if (update.docChanged || update.viewportChanged) this.decorations = marks(update.view);
    }
  }, { decorations: (plugin) => plugin.decorations });
}
