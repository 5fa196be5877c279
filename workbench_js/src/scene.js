// The middle of the page: path, coordinate systems and machine, and the picking of a move.

import * as THREE from "three";
import { AXIS_COLOURS as AXIS, button, colour, el, fill, onTheme } from "./dom.js";
import { tool } from "./chain.js";
import { release } from "./labels.js";
import { MachineModel, setMatrix } from "./machine_model.js";
import { moveOf, poseAt } from "./path.js";
import { goTo, on, rowOf, selectRow, stopPlaying, store } from "./store.js";
import { ToolPath } from "./tool_path.js";
import { triads } from "./triads.js";
import { View } from "./view.js";

const BUDGET = { software: 60_000, hardware: 1_500_000 };
const REACH = 9;
const FRAMES = [["machine", "machine stands"], ["workpiece", "workpiece stands"], ["hidden", "path only"]];

export class Scene {
  constructor(host) {
    this.host = host;
    host.classList.add("nc-scene");
    this.mode = "motion";
    this.bar = el("div", { class: "nc-scene-bar" });
    this.legend = el("div", { class: "nc-legend" });
    this.problem = el("div", { class: "nc-scene-problem nc-hidden" });
    host.append(this.bar, this.legend, this.problem);
    this.view = this.makeView(host);
    if (!this.view) return;
    this.world = new THREE.Group();
    this.view.scene.add(this.world);
    this.workpiece = new THREE.Group();
    this.world.add(this.workpiece);
    this.tip = tipMark();
    this.workpiece.add(this.tip);
    this.frame = null;
    this.fillBar();
    this.ends = [
      on("result", ({ sameProgram }) => this.takePath(sameProgram)),
      on("cursor", () => this.moveCursor()),
      on("place", () => this.mark()),
      on("jog", () => this.moveCursor()),
      on("block", () => this.takeSystems()),
      onTheme(() => { this.dropMachine(); if (this.path) this.path.markOf = this.path.othersOf = null; this.paint(); this.takeSystems(); this.moveCursor(); }),
    ];
    if (store.revision) { this.takePath(false); this.takeSystems(); }
  }

  makeView(host) {
    try {
      return new View(host, {
        click: (x, y) => this.click(x, y),
        changed: (moving) => this.detail(moving),
      });
    } catch {
      host.append(el("div", { class: "nc-empty" }, "This browser has no WebGL: the picture cannot be drawn."));
      return null;
    }
  }

  fillBar() {
    const side = (name, text, key) => button(text, `${name} view (${key})`, () => this.view.look(name));
    this.lens = button("ortho", "orthographic or perspective (O)", () => this.toggleLens());
    this.colours = el("select", { class: "nc-select", "aria-label": "colour of the path", onchange: () => {
      this.mode = this.colours.value;
      this.paint();
    } });
    this.frames = el("select", { class: "nc-select", "aria-label": "machine", onchange: () => {
      this.frame = this.frames.value;
      this.moveCursor();
    } }, FRAMES.map(([value, text]) => el("option", { value }, text)));
    fill(this.bar,
      side("iso", "iso", "0"), side("top", "top", "1"), side("front", "front", "2"), side("right", "right", "3"),
      button("path", "fit the path into the view (F)", () => this.view.fit(this.pathSphere())), button("all", "fit path and machine into the view (A)", () => this.view.fit(this.sphere())), this.lens, this.colours, this.frames,
    );
    this.fillColours();
  }

  fillColours() {
    const choices = [["motion", "rapid and feed"], ["system", "coordinate system"], ...store.path.axisNames.map((a) => [a, `axis ${a}`])];
    if (!choices.some(([value]) => value === this.mode)) this.mode = "motion";
    fill(this.colours, choices.map(([value, text]) => el("option", { value, selected: value === this.mode }, text)));
  }

  toggleLens() {
    this.lens.textContent = this.view.toggleLens() ? "persp" : "ortho";
  }

  // --- what is shown ---------------------------------------------------------------------------

  /** Where and why the program stopped, over the picture of what ran before. */
  showProblem() {
    const first = store.result.diagnostics.find((d) => d.error);
    this.problem.classList.toggle("nc-hidden", store.result.ok && !first);
    if (!first) { fill(this.problem, "the program was stopped"); return; }
    const place = first.line ? `${first.file}:${first.line}` : first.file ?? "";
    fill(this.problem, place && el("button", { type: "button", class: "nc-link", onclick: () => goTo(first.file, first.line) }, place), ` ${first.message}`);
  }

  takePath(keepView) {
    this.showProblem();
    this.path?.dispose();
    this.path = new ToolPath(store.path);
    this.path.group.position.set(...store.path.origin);
    this.world.position.set(...store.path.origin.map((v) => -v));
    this.workpiece.add(this.path.group);
    this.fillColours();
    this.paint();
    this.detail(false);
    this.dropMachine();
    this.frame ??= store.result.machine.kinematics.length ? "machine" : "hidden";
    this.frames.value = this.frame;
    this.moveCursor();
    if (!keepView) this.view.fit(this.sphere());
    this.view.draw();
  }

  /** What fits into the view: the path, and the machine where it is shown. */
  sphere() {
    const found = this.pathSphere();
    if (!this.machine) return found;
    this.world.updateMatrixWorld(true);
    const box = new THREE.Box3().setFromObject(this.machine.root);
    return found.union(box.getBoundingSphere(new THREE.Sphere()).set(box.getCenter(new THREE.Vector3()), box.getSize(new THREE.Vector3()).length() * 0.46));
  }

  /** Around the path, where the workpiece stands now. */
  pathSphere() {
    this.world.updateMatrixWorld(true);
    const centre = new THREE.Vector3();
    if (this.path) centre.setFromMatrixPosition(this.path.group.matrixWorld);
    return new THREE.Sphere(centre, this.radius() * 1.1);
  }

  radius() { return Math.max(this.path?.sphere.radius ?? 50, 1); }

  paint() {
    this.path?.paint(this.mode);
    this.showLegend();
    this.view.draw();
  }

  showLegend() {
    const entry = (shade, text) => el("span", { class: "nc-legend-entry" }, el("i", { style: `background:${shade}` }), text);
    if (this.mode === "motion") fill(this.legend, entry(colour("rapid"), "rapid"), entry(colour("feed"), "feed"));
    else if (this.mode === "system") {
      fill(this.legend, store.path.systems.slice(0, 12).map((name, i) => entry(AXIS[i % AXIS.length], name)));
    } else if (this.path && store.path.moves) {
      const [low, high] = this.path.range(store.path.axisNames.indexOf(this.mode));
      fill(this.legend, el("span", { class: "nc-legend-entry" }, low.toFixed(2), el("i", { class: "nc-gradient" }), high.toFixed(2)));
    }
  }

  detail(moving) {
    if (!this.path) return;
    const budget = this.view.software ? BUDGET.software : BUDGET.hardware;
    const close = this.view.camera.zoom > 4;
    this.path.detail((moving || store.playing) && !close ? budget : Infinity);
  }

  takeSystems() {
    if (this.systems) release(this.systems);
    this.systems = null;
    const found = store.block?.systems ?? [];
    if (found.length) {
      this.systems = triads(found, this.radius() * 0.24);
      this.workpiece.add(this.systems);
    }
    this.view.draw();
  }

  mark() {
    if (!this.path) return;
    this.path.select(rowOf(store.cursor), store.runs, this.view.width, this.view.height);
    this.view.draw();
  }

  moveCursor() {
    const pose = poseAt(store.path, store.cursor);
    this.tip.visible = pose !== null;
    if (pose) this.tip.position.set(...pose.tip.map((v, k) => v + store.path.origin[k]));
    this.moveMachine(pose);
    if (store.playing !== this.wasPlaying) { this.wasPlaying = store.playing; this.detail(false); }
    this.mark();
  }

  // --- the machine -----------------------------------------------------------------------------

  dropMachine() {
    this.machine?.dispose();
    this.machine = null;
  }

  moveMachine(pose) {
    const shown = this.frame !== "hidden" && store.result;
    if (!shown) {
      this.dropMachine();
      setMatrix(this.workpiece, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]);
      return;
    }
    const { chain, positions, length } = this.stand(pose);
    const { axes } = store.result.machine;
    if (this.machine?.given !== chain) {
      this.dropMachine();
      this.machine = new MachineModel(chain, axes, store.path, this.ranges(), this.machineSize(chain));
      this.machine.given = chain;
      this.world.add(this.machine.root);
    }
    this.machine.setLength(length);
    setMatrix(this.workpiece, this.machine.move(positions, this.frame === "machine"));
    if (store.jog) {
      this.tip.position.set(...tool(this.machine.chain, positions, length).tip);
      this.tip.visible = true;
    }
  }

  /** The chain, axis positions by channel index and tool length to show: of the path or jogged. */
  stand(pose) {
    const { machine, models } = store.result;
    const configured = (id) => machine.kinematics.find((k) => k.id === id) ?? null;
    if (store.jog) return { chain: configured(store.jog.kinematics), positions: store.jog.axes, length: store.jog.length };
    const names = store.path.axisNames;
    const positions = machine.axes.map(({ name }) => (pose ? pose.axes[names.indexOf(name)] : 0) ?? 0);
    const selected = pose ? models[store.path.stretch_model[pose.stretch]] : null;
    const chain = selected ?? configured(machine.default) ?? machine.kinematics[0] ?? null;
    return { chain, positions, length: pose ? store.path.stretch_length[pose.stretch] : 0 };
  }

  /** What the path uses of every channel axis. */
  ranges() {
    const names = store.path.axisNames;
    return store.result.machine.axes.map(({ name }) => (names.includes(name) && store.path.moves ? this.path.range(names.indexOf(name)) : null));
  }

  /** Parts as large as suits the path and the distances of the axes, mm. */
  machineSize(chain) {
    const places = [chain?.flange ?? [0, 0, 0], ...(chain?.joints ?? []).filter((j) => !j.linear).map((j) => j.point)];
    const spread = Math.max(...places.flatMap((a) => places.map((b) => Math.hypot(...a.map((v, k) => v - b[k])))));
    return Math.max(this.radius() * 0.9, spread * 0.5, 1);
  }

  click(x, y) {
    if (!this.path) return;
    const row = this.path.pick(this.view.camera, this.view.width, this.view.height, x, y, REACH);
    if (row < 0) return;
    stopPlaying();
    selectRow(moveOf(store.path, row), "scene");
  }

  key(key) {
    const sides = { 0: "iso", 1: "top", 2: "front", 3: "right" };
    if (key in sides) this.view.look(sides[key]);
    else if (key === "f") this.view.fit(this.pathSphere());
    else if (key === "a") this.view.fit(this.sphere());
    else if (key === "o") this.toggleLens();
    else return false;
    return true;
  }

  /** Turns the camera a little about the vertical, as the mouse does: for measurements. */
  spin(angle) {
    const { camera, controls } = this.view, axis = new THREE.Vector3(0, 0, 1);
    camera.position.sub(controls.target).applyAxisAngle(axis, angle).add(controls.target);
    controls.update();
  }

  /** The move at a part of the width and height of the view: for measurements. */
  pick(x, y) {
    return this.path.pick(this.view.camera, this.view.width, this.view.height, x * this.view.width, y * this.view.height, REACH);
  }

  /** Moves of the path when the last picture was drawn. */
  get drawnMoves() { return this.view?.frames && this.path ? this.path.path.moves : 0; }

  /** Where a move is on the page: for tests. */
  pixelOf(row, part = 0.5) {
    const pose = poseAt(store.path, row + part);
    const point = new THREE.Vector3(...pose.tip).applyMatrix4(this.path.group.matrixWorld).project(this.view.camera);
    const box = this.view.renderer.domElement.getBoundingClientRect();
    return [box.left + (point.x * 0.5 + 0.5) * this.view.width, box.top + (0.5 - point.y * 0.5) * this.view.height];
  }

  dispose() {
    for (const end of this.ends ?? []) end();
    this.path?.dispose();
    this.dropMachine();
    this.view?.dispose();
  }
}

function tipMark() {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 32;
  const context = canvas.getContext("2d");
  context.beginPath();
  context.arc(16, 16, 11, 0, 2 * Math.PI);
  context.fillStyle = "#ffffff";
  context.fill();
  context.lineWidth = 6;
  context.strokeStyle = "#d6409f";
  context.stroke();
  const material = new THREE.SpriteMaterial({ map: new THREE.CanvasTexture(canvas), depthTest: false, sizeAttenuation: false });
  const sprite = new THREE.Sprite(material);
  sprite.userData.pixels = [13, 13];
  sprite.renderOrder = 9;
  sprite.visible = false;
  return sprite;
}
