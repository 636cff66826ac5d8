// Where one looks from: within a room, or from above.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Walking } from "./walking.js";

/// The box around what faces rooms, or around all.
function boxOf(model) {
  const box = new THREE.Box3(), p = new THREE.Vector3();
  const any = model.outside.some((flag) => flag === 0);
  for (let k = 0; k < model.polygons; ++k) {
    if (any && model.outside[k]) continue;
    const f = model.frames.subarray(9 * k, 9 * k + 9);
    for (let i = model.firstPoint[k]; i < model.firstPoint[k + 1]; ++i) {
      const x = model.points[2 * i], y = model.points[2 * i + 1];
      box.expandByPoint(p.set(f[0] + x * f[3] + y * f[6], f[1] + x * f[4] + y * f[7], f[2] + x * f[5] + y * f[8]));
    }
  }
  return box;
}

export class Views {
  constructor(model, canvas, onChange) {
    this.canvas = canvas;
    this.box = boxOf(model);
    this.size = Math.max(this.box.getSize(new THREE.Vector3()).length(), 1e-3);
    this.camera = new THREE.PerspectiveCamera(62, 1, Math.min(0.05, 2e-3 * this.size), 20 * this.size);
    this.camera.up.set(0, 0, 1);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.enabled = false;
    this.orbit.addEventListener("change", onChange);
    this.walks = new Walking(this.camera, canvas, onChange);
    this.caster = new THREE.Raycaster();
  }

  get walking() { return this.walks.enabled; }
  aspect(value) {
    this.camera.aspect = value;
    this.camera.updateProjectionMatrix();
  }
  stand(room) {
    this.orbit.enabled = false;
    this.walks.enabled = true;
    this.walks.stand(room.eye, room.look);
  }
  /// From above and across the building's longer side, all of it beside the panel; `cut` is the height up to which there is
  /// something to see.
  lookFromAbove(cut) {
    this.walks.enabled = false;
    const box = this.box.clone(), size = box.getSize(new THREE.Vector3());
    box.max.z = Math.max(box.min.z, Math.min(cut, box.max.z));
    const middle = box.getCenter(new THREE.Vector3());
    const back = size.x >= size.y ? new THREE.Vector3(-0.22, -0.55, 1) : new THREE.Vector3(-0.55, 0.22, 1);
    const right = new THREE.Vector3(0, 0, 1).cross(back.normalize()).normalize(), above = back.clone().cross(right);
    const { clientWidth: wide, clientHeight: high } = this.canvas, panel = wide > 700 ? 380 : 0;
    const half = Math.tan(0.5 * ((this.camera.fov * Math.PI) / 180));
    let away = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const d = new THREE.Vector3(...[0, 1, 2].map((c) => (corner >> c & 1 ? box.max : box.min).getComponent(c))).sub(middle);
      const across = Math.abs(d.dot(right)) / ((half * (wide - panel)) / high), upward = Math.abs(d.dot(above)) / half;
      away = Math.max(away, d.dot(back) + 1.05 * Math.max(across, upward));
    }
    middle.addScaledVector(right, (panel / high) * half * away);
    this.camera.position.copy(middle).addScaledVector(back, away);
    this.orbit.target.copy(middle);
    this.orbit.enabled = true;
    this.orbit.update();
  }
  run(seconds) { return this.walks.run(seconds); }
  position() { return this.camera.position; }
  yaw() {
    const d = this.camera.getWorldDirection(new THREE.Vector3());
    return Math.atan2(d.y, d.x);
  }
  ray(x, y) {
    const box = this.canvas.getBoundingClientRect();
    const at = new THREE.Vector2((2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height);
    this.camera.updateMatrixWorld();
    this.caster.setFromCamera(at, this.camera);
    return { from: this.caster.ray.origin.toArray(), direction: this.caster.ray.direction.toArray() };
  }
}
