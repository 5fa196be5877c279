// Short texts in the scene, drawn on a small canvas.

import * as THREE from "three";

/** A sprite that keeps its size on the screen. */
export function label(text, fill, halo, pixels = 15) {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  const font = `600 ${pixels * 2}px system-ui, sans-serif`;
  context.font = font;
  canvas.width = Math.ceil(context.measureText(text).width) + 16;
  canvas.height = pixels * 2 + 16;
  context.font = font;
  context.textBaseline = "middle";
  context.lineJoin = "round";
  context.lineWidth = 6;
  context.strokeStyle = halo;
  context.strokeText(text, 8, canvas.height / 2);
  context.fillStyle = fill;
  context.fillText(text, 8, canvas.height / 2);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  const material = new THREE.SpriteMaterial({ map: texture, depthTest: false, sizeAttenuation: false, transparent: true });
  const sprite = new THREE.Sprite(material);
  sprite.renderOrder = 10;
  sprite.userData.pixels = [canvas.width / 2, canvas.height / 2];
  return sprite;
}

/** Sets the sizes of all labels below a node for a camera and a height of the view in pixels. */
export function sizeLabels(root, camera, height) {
  root.traverse((node) => {
    if (!node.userData.pixels) return;
    const [w, h] = node.userData.pixels;
    const unit = camera.isPerspectiveCamera
      ? (2 * Math.tan((camera.fov * Math.PI) / 360)) / height
      : (camera.top - camera.bottom) / camera.zoom / height;
    node.scale.set(w * unit, h * unit, 1);
  });
}

/** Frees what a node and those below it hold on the graphics card. */
export function release(root) {
  root.traverse((node) => {
    node.geometry?.dispose();
    for (const material of [node.material].flat()) {
      material?.map?.dispose();
      material?.dispose();
    }
  });
  root.removeFromParent();
}
