// Axis positions and tool poses by hand, to try a kinematics before there is a program.

import { tell } from "./api.js";
import { button, el, fill, oncePerFrame, shown } from "./dom.js";
import { poseAt } from "./path.js";
import { on, setJog, store } from "./store.js";

const LINEAR_REACH = 500;

export class Jog {
  constructor(host) {
    host.classList.add("nc-jog");
    this.host = host;
    this.axes = [];
    this.tool = { tip: [0, 0, 0], direction: [0, 0, 1] };
    this.length = 0;
    this.ask = oncePerFrame(() => this.forward());
    this.ends = [on("result", () => this.take()), on("jog", () => this.showState())];
    this.take();
  }

  /** Another machine: new sliders; the same machine keeps its positions. */
  take() {
    const { machine } = store.result ?? {};
    if (!machine) { fill(this.host, el("div", { class: "nc-empty" }, "choose a program and a machine")); return; }
    const same = JSON.stringify(machine) === this.known;
    if (same) return;
    this.known = JSON.stringify(machine);
    this.machine = machine;
    this.kinematics = machine.kinematics[0]?.id ?? null;
    if (machine.kinematics.some((k) => k.id === machine.default)) this.kinematics = machine.default;
    this.axes = machine.axes.map(() => 0);
    this.build();
  }

  build() {
    const { machine } = this;
    this.sliders = machine.axes.map((axis, i) => new Slider(axis.name, ...rangeOf(axis), axis.rotary ? "°" : "mm", (value) => {
      this.axes[i] = value;
      this.jogged();
    }));
    this.lengthField = number("tool length in mm", 0, (value) => { this.length = value; this.jogged(); });
    this.tipFields = ["X", "Y", "Z"].map((name, k) => number(`tool tip ${name}`, 0, (value) => { this.tool.tip[k] = value; this.inverse(); }));
    this.directionFields = ["I", "J", "K"].map((name, k) => number(`tool direction ${name}`, this.tool.direction[k], (value) => { this.tool.direction[k] = value; this.inverse(); }));
    this.readout = el("div", { class: "nc-jog-tool" });
    this.poses = el("div", { class: "nc-jog-poses" });
    const chooser = el("select", { class: "nc-select", "aria-label": "kinematics", onchange: () => { this.kinematics = Number(chooser.value); this.jogged(); } },
      machine.kinematics.map((k) => el("option", { value: k.id, selected: k.id === this.kinematics }, `kinematics ${k.id}`)));
    fill(this.host,
      el("div", { class: "nc-jog-head" }, machine.kinematics.length ? chooser : el("span", { class: "nc-quiet" }, "no kinematics in the lists"),
        el("label", {}, "tool length ", this.lengthField),
        button("from the path", "positions of the current block", () => this.fromPath()), this.back = button("back to the path", "show the path again", () => setJog(null), "nc-back")),
      el("div", { class: "nc-jog-body" },
        el("h3", {}, "Axes"), this.sliders.map((s) => s.row), this.readout,
        machine.kinematics.length ? [
          el("h3", {}, "Tool tip and direction, in the workpiece"),
          el("div", { class: "nc-jog-fields" }, "tip", this.tipFields), el("div", { class: "nc-jog-fields" }, "direction", this.directionFields),
          this.poses,
        ] : null),
    );
    this.showState();
  }

  showState() { this.back?.classList.toggle("nc-hidden", store.jog === null); }

  fromPath() {
    const pose = poseAt(store.path, store.cursor);
    if (!pose) return;
    const names = store.path.axisNames;
    this.axes = this.machine.axes.map((axis) => pose.axes[names.indexOf(axis.name)] || 0);
    const model = store.result.models[store.path.stretch_model[pose.stretch]];
    if (model && this.machine.kinematics.some((k) => k.id === model.id)) this.kinematics = model.id;
    this.length = store.path.stretch_length[pose.stretch];
    this.lengthField.value = this.length;
    this.sliders.forEach((slider, i) => slider.set(this.axes[i]));
    this.jogged();
  }

  jogged() {
    setJog({ axes: this.axes.slice(), length: this.length, kinematics: this.kinematics });
    this.ask();
  }

  async forward() {
    if (this.kinematics === null) return;
    const question = { id: this.kinematics, axes: this.axes, length: this.length };
    const found = await this.answer(question);
    if (!found) return;
    if (found.problem) { fill(this.readout, el("span", { class: "nc-bad" }, found.problem)); return; }
    fill(this.readout,
      numbers("tip", found.tip), numbers("direction", found.direction),
      el("div", {}, found.pose === null ? "" : `pose ${found.pose > 0 ? "+1" : "-1"}, `, `condition ${found.condition.map((c) => (c === null ? "∞" : c.toFixed(2))).join(" / ")}`),
    );
    this.tool = { tip: found.tip, direction: found.direction };
    this.tipFields.forEach((field, k) => { field.value = trimmed(found.tip[k]); });
    this.directionFields.forEach((field, k) => { field.value = trimmed(found.direction[k], 6); });
    this.inverse(false);
  }

  /** Both poses of the tool; `jog`: the machine takes the one nearest to where it stands. */
  async inverse(jog = true) {
    if (this.kinematics === null) return;
    const found = await this.answer({ id: this.kinematics, axes: this.axes, length: this.length, ...this.tool });
    if (!found) return;
    fill(this.poses, found.map((pose) => this.poseRow(pose)));
    const good = found.find((pose) => !pose.problem);
    if (jog && good) this.put(good.axes);
  }

  poseRow(pose) {
    const name = `pose ${pose.pose > 0 ? "+1" : "-1"}`;
    if (pose.problem) return el("div", { class: "nc-jog-pose" }, el("b", {}, name), el("span", { class: "nc-bad" }, pose.problem));
    return el("div", { class: "nc-jog-pose", "data-pose": pose.pose, "data-axes": JSON.stringify(pose.axes) }, el("b", {}, name),
      el("span", { class: "nc-value" }, this.machine.axes.map((a, i) => `${a.name} ${shown(pose.axes[i], 3)}`).join("  ")),
      button("take", `move to ${name}`, () => this.put(pose.axes)));
  }

  put(axes) {
    this.axes = axes.slice(0, this.machine.axes.length);
    this.sliders.forEach((slider, i) => slider.set(this.axes[i]));
    setJog({ axes: this.axes.slice(), length: this.length, kinematics: this.kinematics });
  }

  /** The newest answer, null for one that is out of date or refused. */
  async answer(question) {
    const number = this.asked = (this.asked ?? 0) + 1;
    try {
      const found = await tell("/jog", question);
      return number === this.asked ? found : null;
    } catch (error) {
      if (number === this.asked) fill(this.poses, el("span", { class: "nc-bad" }, error.message));
      return null;
    }
  }

  dispose() { for (const end of this.ends) end(); }
}

class Slider {
  constructor(name, low, high, unit, changed) {
    this.range = el("input", { type: "range", min: low, max: high, step: "any", value: 0, "aria-label": `axis ${name}`, oninput: () => { this.field.value = trimmed(Number(this.range.value), 3); changed(Number(this.range.value)); } });
    this.field = number(`position of axis ${name}`, 0, (value) => { this.range.value = value; changed(value); });
    this.row = el("div", { class: "nc-jog-axis" }, el("b", {}, name), this.range, this.field, el("span", { class: "nc-quiet" }, unit));
  }

  set(value) {
    this.range.value = value;
    this.field.value = trimmed(value);
  }
}

function rangeOf(axis) {
  if (axis.limits) return axis.limits;
  return axis.rotary ? axis.modulo ?? [-180, 180] : [-LINEAR_REACH, LINEAR_REACH];
}

function number(hint, value, changed) {
  return el("input", { type: "number", step: "any", value, class: "nc-number", title: hint, "aria-label": hint, onchange: (event) => {
    const given = Number(event.target.value);
    if (Number.isFinite(given)) changed(given);
  } });
}

const trimmed = (value, digits = 4) => Number(value.toFixed(digits));

function numbers(name, values) {
  return el("div", {}, `${name} `, values.map((v) => el("span", { class: "nc-value" }, shown(v))));
}
