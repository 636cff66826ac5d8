// Standing in a room and looking about: keys, mouse and touch. Walls are no obstacle.

const forward = ["KeyW", "ArrowUp"], backward = ["KeyS", "ArrowDown"], left = ["KeyA"], right = ["KeyD"];
const turnLeft = ["ArrowLeft"], turnRight = ["ArrowRight"], up = ["KeyE", "PageUp"], down = ["KeyQ", "PageDown"];
const all = [forward, backward, left, right, turnLeft, turnRight, up, down].flat();
const walkingSpeed = 1.8, turningSpeed = 1.6;  // m/s, rad/s

export class Walking {
  constructor(camera, canvas, onChange) {
    this.camera = camera;
    this.onChange = onChange;
    this.enabled = false;
    this.yaw = this.pitch = 0;
    this.keys = new Set();
    this.fingers = new Map();
    canvas.addEventListener("keydown", (e) => this.key(e, true));
    canvas.addEventListener("keyup", (e) => this.key(e, false));
    canvas.addEventListener("blur", () => this.keys.clear());
    canvas.addEventListener("pointerdown", (e) => this.fingers.set(e.pointerId, { x: e.clientX, y: e.clientY }));
    for (const name of ["pointerup", "pointercancel", "pointerleave"])
      canvas.addEventListener(name, (e) => this.fingers.delete(e.pointerId));
    canvas.addEventListener("pointermove", (e) => this.drag(e));
    canvas.addEventListener("wheel", (e) => {
      if (!this.enabled) return;
      e.preventDefault();
      this.step(-e.deltaY * 0.002, 0, 0);
      this.onChange();
    }, { passive: false });
  }

  stand(eye, look) {
    this.camera.position.set(...eye);
    this.yaw = Math.atan2(look[1], look[0]);
    this.pitch = Math.atan2(look[2], Math.hypot(look[0], look[1]));
    this.turn(0, 0);
  }

  key(event, pressed) {
    if (!this.enabled || !all.includes(event.code) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    if (pressed) this.keys.add(event.code);
    else this.keys.delete(event.code);
    this.fast = event.shiftKey;
    this.onChange();
  }

  drag(event) {
    const before = this.fingers.get(event.pointerId);
    if (!before || !this.enabled) return;
    const dx = event.clientX - before.x, dy = event.clientY - before.y;
    this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const perPixel = ((this.camera.fov * Math.PI) / 180) / event.target.clientHeight;
    if (this.fingers.size > 1) this.step(-dy * 0.01, dx * 0.01, 0);  // two fingers walk
    else this.turn(dx * perPixel, dy * perPixel);
    this.onChange();
  }

  turn(left, upward) {
    this.yaw += left;
    this.pitch = Math.max(-1.5, Math.min(1.5, this.pitch + upward));
    const flat = Math.cos(this.pitch), { position } = this.camera;
    this.camera.up.set(0, 0, 1);
    this.camera.lookAt(position.x + flat * Math.cos(this.yaw), position.y + flat * Math.sin(this.yaw), position.z + Math.sin(this.pitch));
  }

  step(ahead, aside, upward) {
    const { position } = this.camera, c = Math.cos(this.yaw), s = Math.sin(this.yaw);
    position.set(position.x + ahead * c + aside * s, position.y + ahead * s - aside * c, position.z + upward);
  }

  /// Carries on what keys ask for; true while one is held.
  run(seconds) {
    if (!this.enabled || this.keys.size === 0) return false;
    const held = (more, less) => more.some((k) => this.keys.has(k)) - less.some((k) => this.keys.has(k));
    const way = seconds * walkingSpeed * (this.fast ? 3 : 1);
    this.step(way * held(forward, backward), way * held(right, left), way * held(up, down));
    this.turn(seconds * turningSpeed * held(turnLeft, turnRight), 0);
    return true;
  }
}
