// Single keys of the page; they do not count in editors and fields.

import { setCursor, step, stepRun, stopPlaying, togglePlaying } from "./store.js";

const to = (cursor) => { stopPlaying(); setCursor(cursor, "step"); };
const ACTIONS = {
  ArrowRight: () => step(1), ArrowLeft: () => step(-1), Home: () => to(1), End: () => to(Infinity),
  " ": togglePlaying, PageDown: () => stepRun(1), PageUp: () => stepRun(-1),
};

/** others: gets a key that is not for stepping, answers whether it took it. */
export function watchKeys(others) {
  const handler = (event) => {
    const { target } = event;
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (target.closest?.("input:not([type=range]):not([type=checkbox]), textarea, select, [contenteditable=true], .q-dialog, .q-menu")) return;
    if (event.key === " " && target.closest?.("button, [role=tab]")) return;
    const action = ACTIONS[event.key];
    if (action) action(); else if (!others(event.key.toLowerCase())) return;
    event.preventDefault();
  };
  window.addEventListener("keydown", handler, true);
  return () => window.removeEventListener("keydown", handler, true);
}
