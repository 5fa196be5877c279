// Elements from data. Text is always a text node: what a program or list says never becomes HTML.

/** An element with attributes (`class`, `title`, ..), `on...` handlers and children. */
export function el(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (value === true) node.setAttribute(name, "");
    else node.setAttribute(name, String(value));
  }
  for (const child of children.flat()) {
    if (child === null || child === undefined || child === false) continue;
    node.append(child instanceof Node ? child : document.createTextNode(String(child)));
  }
  return node;
}

/** The children of a node replaced. */
export function fill(node, ...children) {
  node.replaceChildren(...children.flat().filter((c) => c !== null && c !== undefined && c !== false));
}

/** A small button with a text that is also its name for tests and readers. */
export function button(text, hint, handler, extra = "") {
  return el("button", { type: "button", class: `nc-button ${extra}`, title: hint, "aria-label": hint, onclick: handler }, text);
}

/** Calls at most once a frame, with the last arguments. */
export function oncePerFrame(handler) {
  let waiting = false;
  return () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; handler(); });
  };
}

export const isDark = () => document.body.classList.contains("body--dark");

/** Calls the handler whenever dark and light are switched; returns the way to end it. */
export function onTheme(handler) {
  let dark = isDark();
  const observer = new MutationObserver(() => {
    if (dark === isDark()) return;
    dark = isDark();
    handler(dark);
  });
  observer.observe(document.body, { attributes: true, attributeFilter: ["class"] });
  return () => observer.disconnect();
}

/** A colour of the style sheet. */
export const colour = (name) => getComputedStyle(document.body).getPropertyValue(`--nc-${name}`).trim();

export const AXIS_COLOURS = [
  "#e5484d", "#30a46c", "#3e7bfa", "#f0a020", "#a15bd8", "#12a5a5", "#d6409f", "#8a7a5c",
];

/** A number for reading: four decimals, the resolution of the control, never a negative zero. */
export function shown(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "";
  const text = value.toFixed(digits);
  return /^-0\.?0*$/.test(text) ? text.slice(1) : text;
}
