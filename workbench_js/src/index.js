// What the page loads: it mounts the parts and hands them the state of the session.

import uPlotStyle from "uplot/dist/uPlot.min.css";
import { Code } from "./code.js";
import { Display } from "./display.js";
import { el } from "./dom.js";
import { watchKeys } from "./keys.js";
import { Jog } from "./jog.js";
import { Messages } from "./messages.js";
import { Scene } from "./scene.js";
import { Status } from "./status.js";
import { receiveState, startSession, store } from "./store.js";
import style from "./style.css";
import { Timeline } from "./timeline.js";

const PANES = { code: Code, scene: Scene, display: Display, timeline: Timeline, messages: Messages, jog: Jog, status: Status };

document.head.append(el("style", {}, uPlotStyle, style));
const mounted = {};
watchKeys((key) => mounted.scene?.key(key) ?? false);

/** Draws one part of the page into an element. */
export function mountPane(kind, host, session) {
  startSession(session);
  const pane = new PANES[kind](host);
  mounted[kind] = pane;
  return pane;
}

export { receiveState };

/** For tests and the load measurement. */
window.ncscope = { store, panes: mounted };
