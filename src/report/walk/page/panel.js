// The controls beside the building, and what they ask for.
import { shown } from "./model.js";
import { Plan, roomTable } from "./rooms.js";
import { Scale, usualScale } from "./scale.js";

const byId = (id) => document.getElementById(id);
const press = (button, pressed) => button.setAttribute("aria-pressed", pressed);
const steps = 8;

export class Panel {
  constructor(page) {
    this.page = page;
    this.model = page.model;
    this.storeys = 0xffffffff;
    this.outside = false;
    this.room = undefined;
    byId("title").textContent = this.model.title;
    this.scale = new Scale(this.model, byId("legend"));
    Object.assign(this.scale, usualScale(this.model, page.light));
    this.table = roomTable(this.model, byId("rooms"), (index) => page.enter(index));
    this.plan = new Plan(this.model, byId("plan"), this.scale, (index) => page.enter(index));
    this.addModes();
    this.addStoreys();
    this.addScale();
    this.addLamps();
    this.tell();
  }

  addModes() {
    const shade = (colours) => {
      this.colours = colours;
      press(byId("light"), !colours);
      press(byId("colours"), colours);
      document.body.classList.toggle("false-colour", colours);
      this.page.changed();
    };
    byId("light").addEventListener("click", () => shade(false));
    byId("colours").addEventListener("click", () => shade(true));
    byId("overview").addEventListener("click", () => this.page.overview());
    byId("fold").addEventListener("click", () => {
      const folded = byId("panel").classList.toggle("folded");
      byId("fold").setAttribute("aria-expanded", !folded);
    });
    byId("exposure").addEventListener("input", () => this.page.changed());
    byId("patches").addEventListener("change", (e) => {
      this.page.surfaces.smoothed = !e.target.checked;
      this.page.surfaces.showLight();
      this.page.draw();
    });
    byId("outside").addEventListener("change", (e) => {
      this.outside = e.target.checked;
      this.page.changed();
    });
  }

  addStoreys() {
    const group = byId("storeys"), { storeys } = this.model;
    group.classList.toggle("hidden", storeys.length < 2);
    this.buttons = storeys.map((storey, i) => {
      const button = document.createElement("button");
      button.textContent = storey.name;
      press(button, true);
      button.addEventListener("click", () => this.setStorey(i, !this.shows(i)));
      return button;
    });
    group.replaceChildren(...this.buttons);
  }
  shows(storey) { return (this.storeys >>> Math.min(storey, 31) & 1) === 1; }
  setStorey(storey, on) {
    const bit = (1 << Math.min(storey, 31)) >>> 0;
    this.storeys = (on ? this.storeys | bit : this.storeys & ~bit) >>> 0;
    this.buttons.forEach((button, i) => press(button, this.shows(i)));
    this.page.changed();
  }
  storeyOn(storey) { if (!this.shows(storey)) this.setStorey(storey, true); }
  /// Below the ceilings of the highest storey that is shown.
  topCut() {
    const top = this.model.storeys.map((_, i) => i).filter((i) => this.shows(i)).pop();
    return top === undefined ? 1e30 : this.model.storeys[top].cut;
  }

  addScale() {
    const read = () => {
      const low = Number(byId("lowest").value), high = Number(byId("highest").value);
      this.scale.logarithmic = byId("logarithmic").checked;
      const fits = high > low && (this.scale.logarithmic ? low > 0 : low >= 0);
      for (const id of ["lowest", "highest"]) byId(id).setAttribute("aria-invalid", !fits);
      if (fits) Object.assign(this.scale, { lowest: low, highest: high });
      this.scale.steps = byId("steps").checked ? steps : 0;
      this.scale.draw();
      this.plan.colour();
      this.page.changed();
    };
    byId("lowest").value = this.scale.lowest;
    byId("highest").value = this.scale.highest;
    for (const id of ["lowest", "highest", "logarithmic", "steps"]) byId(id).addEventListener("change", read);
    this.scale.draw();
  }

  addLamps() {
    const { shares } = this.model, sliders = byId("lamps").querySelector(".sliders");
    byId("lamps").querySelector("p").textContent = shares.length > 0 ? "" :
      "This run has one solution for all lamps together. enfilade solve --shares keeps each lamp's own, and then they can be dimmed here.";
    const inputs = shares.map((share) => {
      const label = document.createElement("label"), input = document.createElement("input"), output = document.createElement("output");
      label.className = "slider";
      Object.assign(input, { type: "range", min: 0, max: 1, step: 0.01, value: 1 });
      output.textContent = "100%";
      label.append(share.name, input, output);
      input.addEventListener("input", () => {
        output.textContent = `${Math.round(100 * input.value)}%`;
        this.dimSoon(inputs.map((i) => Number(i.value)));
      });
      sliders.append(label);
      return input;
    });
    if (shares.length > 0) byId("lamps").open = true;
  }
  /// Once a frame, however fast a slider moves.
  dimSoon(dims) {
    if (this.dims === undefined) requestAnimationFrame(() => {
      this.page.dim(this.dims);
      this.dims = undefined;
    });
    this.dims = dims;
  }

  tell() {
    const { model } = this, light = model.surveyed ?
      `Mean of the working plane (${shown(model.plane)} m above the floor), as enfilade rooms tells it.` :
      "Floor: the mean that its patches show. The table of the working plane comes with solve --rooms or enfilade walk --rooms.";
    byId("rooms-note").textContent = model.rooms.length > 0 ? light : "No rooms were found in this building.";
    byId("about").textContent = `Light is that of the solution's ${model.faces.toLocaleString("en")} patches, kept to 0.05%; the estimated error of what ` +
      `patches show is ${(100 * model.patchError).toPrecision(2)}%. The value under the pointer is ` +
      `${model.lumens ? "the illuminance of the surface there, and its luminance" : "the irradiance of the surface there, and its radiance"} ` +
      "by the patch itself. Brightness is shown by Reinhard's photographic curve. Surfaces reflect diffusely. Made by Enfilade, shown by three.js (MIT licence).";
  }

  apply(uniforms) {
    const stops = Number(byId("exposure").value);
    byId("exposure-value").textContent = `${stops > 0 ? "+" : ""}${stops.toFixed(1)}`;
    const set = { falseColour: this.colours === true, exposure: this.model.exposure * 2 ** stops, lowest: this.scale.lowest,
      highest: this.scale.highest, logarithmic: this.scale.logarithmic, steps: this.scale.steps };
    for (const [name, value] of Object.entries(set)) uniforms[name].value = value;
    press(byId("overview"), !this.page.views.walking);
  }

  /// The camera is in this room (-1: in none).
  follow(position, room, yaw) {
    if (room >= 0) this.plan.show(this.model.rooms[room].storey);
    else if (this.plan.storey < 0) this.plan.show(0);
    this.plan.look(position, yaw);
    this.plan.eye.classList.toggle("hidden", !this.page.views.walking);
    if (room === this.room) return;
    this.room = room;
    this.table.mark(room);
    for (const shape of this.plan.shapes ?? []) shape.classList.toggle("here", Number(shape.dataset.room) === room);
  }
}
