// The walk-through: a solved building in the browser, with its light under the pointer.
import * as THREE from "three";
import { Light } from "./light.js";
import { Lamps } from "./lamps.js";
import { loadModel, shown } from "./model.js";
import { Panel } from "./panel.js";
import { Picker } from "./picking.js";
import { roomAt } from "./rooms.js";
import { Surfaces } from "./surfaces.js";
import { Views } from "./views.js";

const byId = (id) => document.getElementById(id);

class Page {
  constructor(model) {
    this.model = model;
    this.canvas = byId("view");
    this.light = new Light(model);
    this.surfaces = new Surfaces(model, this.light);
    this.picker = new Picker(model, this.light);
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: true });
    this.renderer.setClearColor(0x22252b);
    this.scene = new THREE.Scene();
    this.lamps = new Lamps(model);
    this.scene.add(this.surfaces.mesh, this.lamps.group);
    this.views = new Views(model, this.canvas, () => this.draw());
    this.panel = new Panel(this);
    addEventListener("resize", () => this.resize());
    this.listen();
    this.resize();
    if (model.start < 0) this.overview();
    else this.enter(model.start);
  }

  /// Stands in a room, its storey shown.
  enter(index) {
    const room = this.model.rooms[index];
    this.panel.storeyOn(room.storey);
    this.views.stand(room);
    this.changed();
  }
  overview() {
    this.views.lookFromAbove(this.panel.topCut());
    this.changed();
  }

  /// What is shown follows from the panel and from where the camera is.
  view() {
    const walking = this.views.walking, { storeys, outside } = this.panel;
    return { storeys, outside: walking || outside || this.model.noRooms, backs: walking, cut: walking ? 1e30 : this.panel.topCut() };
  }
  changed() {
    const view = this.view(), { uniforms } = this.surfaces;
    Object.assign(uniforms.storeys, { value: view.storeys });
    Object.assign(uniforms.showOutside, { value: view.outside });
    Object.assign(uniforms.showBacks, { value: view.backs });
    Object.assign(uniforms.cut, { value: view.cut });
    this.panel.apply(uniforms);
    this.draw();
  }
  dim(dims) {
    this.light.dim(dims);
    this.surfaces.relight();
    this.lamps.dim(dims);
    if (this.pointer) this.read(this.pointer);
    this.draw();
  }

  resize() {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(w, h, false);
    this.views.aspect(w / h);
    this.draw();
  }

  /// Once a frame at most, and only where something has changed.
  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame((now) => {
      this.waiting = false;
      if (this.views.run(Math.min(0.1, (now - (this.before ?? now)) / 1000))) this.draw();
      this.before = this.waiting ? now : undefined;
      this.lamps.show(this.panel.storeys, this.views.camera, this.canvas.clientHeight);
      this.renderer.render(this.scene, this.views.camera);
      const at = this.views.position();
      this.panel.follow(at, this.views.walking ? roomAt(this.model, at.toArray(), 0.5) : -1, this.views.yaw());
      if (this.hover) this.read(this.hover);
      this.hover = null;
    });
  }

  listen() {
    let from = null;
    this.canvas.addEventListener("pointerdown", (e) => { from = { x: e.clientX, y: e.clientY }; });
    this.canvas.addEventListener("pointermove", (e) => {
      if (e.buttons !== 0) return;
      this.hover = { x: e.clientX, y: e.clientY };
      this.draw();
    });
    this.canvas.addEventListener("pointerup", (e) => {
      if (!from || Math.hypot(e.clientX - from.x, e.clientY - from.y) > 6) return;
      const hit = this.read({ x: e.clientX, y: e.clientY });
      if (!this.views.walking && hit) this.enterAt(hit);
    });
  }
  enterAt(hit) {
    const index = roomAt(this.model, hit.p.map((x, c) => x + 0.05 * hit.normal[c]));
    if (index >= 0 && this.model.rooms[index].eye) this.enter(index);
  }

  /// Shows the light under a point of the window; returns what is there.
  read(pointer) {
    this.pointer = pointer;
    const { from, direction } = this.views.ray(pointer.x, pointer.y);
    const hit = this.picker.pick(from, direction, this.view());
    const reading = byId("reading");
    reading.replaceChildren();
    for (const key of Object.keys(reading.dataset)) delete reading.dataset[key];
    const lamp = this.lamps.at(pointer.x, pointer.y, this.views.camera, this.canvas, hit ? hit.distance : Infinity);
    if (lamp) {
      reading.textContent = `${lamp.name}: ${Math.round(100 * lamp.dim)}%`;
      Object.assign(reading.dataset, { lamp: lamp.name, dim: lamp.dim });
      return null;
    }
    if (!hit) return null;
    if (!hit.front) {
      reading.textContent = "the back of a surface: no light";
      return hit;
    }
    const { irradiance, radiosity } = this.picker.lightAt(hit), { model } = this;
    const index = roomAt(model, hit.p.map((x, c) => x + 0.05 * hit.normal[c]));
    const strong = document.createElement("b");
    strong.textContent = `${shown(irradiance)} ${model.unit}`;
    const per = model.lumens ? "cd/m²" : "W/(m² sr)";
    const room = index < 0 ? "" : `, ${model.rooms[index].name}`;
    reading.append(strong, ` luminance ${shown(radiosity / Math.PI)} ${per}${room}`.replace("luminance", model.lumens ? "luminance" : "radiance"));
    Object.assign(reading.dataset, { value: irradiance, radiosity, p: hit.p.map((x, c) => x + model.centre[c]).join(","), n: hit.normal.join(",") });
    return hit;
  }
}

loadModel().then((model) => {
  model.noRooms = model.outside.every((flag) => flag === 1);
  new Page(model);
  byId("wait").hidden = true;
  requestAnimationFrame(() => requestAnimationFrame(() => { document.body.dataset.ready = Math.round(performance.now()); }));
}).catch((fault) => {
  byId("wait").textContent = `This page cannot be shown: ${fault.message}. It needs a browser with WebGL 2 and DecompressionStream (any of 2023 or later).`;
  console.error(fault);
});
