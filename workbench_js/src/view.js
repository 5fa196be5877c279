// Camera, mouse and drawing on demand: a view of three dimensions that knows nothing of machines.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { sizeLabels } from "./labels.js";

const SIDES = {
  iso: [1, -1.2, 0.9], top: [0, -1e-4, 1], front: [0, -1, 0], right: [1, 0, 0], left: [-1, 0, 0],
  back: [0, 1, 0], bottom: [0, -1e-4, -1],
};
const CLICK_PIXELS = 4;

export class View {
  /** changed: called while the camera moves (true) and when it rests (false). */
  constructor(host, { click, changed }) {
    this.host = host;
    this.scene = new THREE.Scene();
    this.renderer = makeRenderer();
    this.software = isSoftware(this.renderer);
    host.append(this.renderer.domElement);
    this.lens = { orthographic: new THREE.OrthographicCamera(), perspective: new THREE.PerspectiveCamera(35) };
    for (const camera of Object.values(this.lens)) camera.up.set(0, 0, 1);
    this.camera = this.lens.orthographic;
    this.sphere = new THREE.Sphere(new THREE.Vector3(), 100);
    this.changed = changed;
    this.addLight();
    this.watch(click);
    this.control();
    this.look("iso");
  }

  addLight() {
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x777788, 2.2));
    const sun = new THREE.DirectionalLight(0xffffff, 1.6);
    sun.position.set(0.4, -0.7, 1);
    this.scene.add(sun);
  }

  watch(click) {
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.host);
    const canvas = this.renderer.domElement;
    let down = null;
    canvas.addEventListener("pointerdown", (event) => { down = [event.clientX, event.clientY]; });
    canvas.addEventListener("pointerup", (event) => {
      if (!down || event.button !== 0) return;
      const moved = Math.hypot(event.clientX - down[0], event.clientY - down[1]);
      const box = canvas.getBoundingClientRect();
      if (moved <= CLICK_PIXELS) click(event.clientX - box.left, event.clientY - box.top);
      down = null;
    });
    canvas.addEventListener("webglcontextrestored", () => this.draw());
  }

  control() {
    this.controls?.dispose();
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.zoomToCursor = true;
    this.controls.screenSpacePanning = true;
    this.controls.target.copy(this.sphere.center);
    let rest = 0;
    this.controls.addEventListener("change", () => {
      this.changed(true);
      this.draw();
      clearTimeout(rest);
      rest = setTimeout(() => { this.changed(false); this.draw(); }, 250);
    });
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!width || !height) return;
    this.width = width;
    this.height = height;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(width, height);
    this.shape();
    this.draw();
  }

  /** Adapts the camera to the size of the view and to the distance of what it shows. */
  shape() {
    const ratio = (this.width || 1) / (this.height || 1);
    const { orthographic, perspective } = this.lens;
    const half = (orthographic.top - orthographic.bottom) / 2;
    orthographic.left = -half * ratio;
    orthographic.right = half * ratio;
    perspective.aspect = ratio;
    const away = this.camera.position.distanceTo(this.sphere.center), reach = this.sphere.radius * 6;
    perspective.near = Math.max(away / 1000, away - reach, 0.01);
    perspective.far = away + reach;
    orthographic.near = away - reach * 4;
    orthographic.far = away + reach * 4;
    this.camera.updateProjectionMatrix();
  }

  /** Another side, the whole in view. */
  look(side) {
    this.way = new THREE.Vector3(...SIDES[side]).normalize();
    this.place();
  }

  /** Keeps the direction of the view and fits the sphere into it. */
  fit(sphere = this.sphere) {
    this.sphere = sphere.clone();
    this.way = this.camera.position.clone().sub(this.controls.target).normalize();
    this.place();
  }

  place() {
    const ratio = (this.width || 1) / (this.height || 1), radius = this.sphere.radius * 1.08;
    const { orthographic, perspective } = this.lens;
    const half = radius / Math.min(1, ratio);
    Object.assign(orthographic, { top: half, bottom: -half, zoom: 1 });
    const away = half / Math.sin((perspective.fov * Math.PI) / 360);
    for (const camera of [orthographic, perspective]) {
      camera.position.copy(this.sphere.center).addScaledVector(this.way, away);
    }
    this.controls.target.copy(this.sphere.center);
    this.controls.update();
    this.shape();
    this.draw();
  }

  toggleLens() {
    const from = this.camera, to = from.isPerspectiveCamera ? this.lens.orthographic : this.lens.perspective;
    const target = this.controls.target.clone(), way = from.position.clone().sub(target);
    const half = from.isPerspectiveCamera
      ? way.length() * Math.tan((from.fov * Math.PI) / 360) : from.top / from.zoom;
    if (to.isPerspectiveCamera) way.setLength(half / Math.tan((to.fov * Math.PI) / 360));
    else Object.assign(to, { top: half, bottom: -half, zoom: 1 });
    to.position.copy(target).add(way);
    this.camera = to;
    this.control();
    this.controls.target.copy(target);
    this.controls.update();
    this.shape();
    this.draw();
    return to.isPerspectiveCamera;
  }

  /** Draws before the next picture of the screen; nothing is drawn while nothing changes. */
  draw() {
    if (this.drawing) return;
    this.drawing = requestAnimationFrame(() => {
      this.drawing = 0;
      if (!this.width) return;
      this.shape();
      sizeLabels(this.scene, this.camera, this.height);
      this.renderer.render(this.scene, this.camera);
      this.frames = (this.frames ?? 0) + 1;
    });
  }

  dispose() {
    cancelAnimationFrame(this.drawing);
    this.observer.disconnect();
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.renderer.domElement.remove();
  }
}

/** Antialiasing costs three times the time where the processor draws. */
function makeRenderer() {
  const probe = document.createElement("canvas").getContext("webgl2");
  const software = probe ? /swiftshader|llvmpipe|software/i.test(deviceOf(probe)) : false;
  probe?.getExtension("WEBGL_lose_context")?.loseContext();
  return new THREE.WebGLRenderer({ antialias: !software, alpha: true, powerPreference: "high-performance" });
}

function deviceOf(gl) {
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  return String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}

const isSoftware = (renderer) => /swiftshader|llvmpipe|software/i.test(deviceOf(renderer.getContext()));
