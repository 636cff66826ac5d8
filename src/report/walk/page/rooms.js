// The table of rooms and the plan of a storey: both take the camera into a room.
import { shown } from "./model.js";

const svg = "http://www.w3.org/2000/svg";

/// A room's light in the table: of the working plane where it was surveyed, else of the floor.
export const lightOf = (room) => room.mean ?? room.floorLight;

function columns(model) {
  const list = [
    { head: "Room", value: (r) => [r.name, r.longName].filter(Boolean).join(" "), text: true },
    { head: "Storey", value: (r) => model.storeys[r.storey].name, text: true },
    { head: "m²", value: (r) => r.area, show: (v) => v.toFixed(1) },
    { head: model.surveyed ? `Mean, ${model.unit}` : `Floor, ${model.unit}`, value: lightOf },
  ];
  if (model.rooms.some((r) => r.u0 !== undefined)) list.push({ head: "U0", value: (r) => r.u0, show: (v) => v.toFixed(2) });
  if (model.rooms.some((r) => r.required)) {
    list.push({ head: "Asked", value: (r) => r.required });
    list.push({ head: "", value: (r) => r.verdict, text: true });
  }
  return list;
}

/// Fills the table; `enter(index)` is called for the room that is chosen.
export function roomTable(model, table, enter) {
  const list = columns(model), body = table.createTBody(), head = table.createTHead().insertRow();
  const rows = model.rooms.map((room, index) => {
    const row = body.insertRow();
    row.dataset.room = index;
    list.forEach((column, i) => {
      const value = column.value(room), cell = row.insertCell();
      if (!column.text) cell.className = "n";
      const text = value === undefined || value === null ? "" : column.text ? value : (column.show ?? shown)(value);
      if (i > 0) return void (cell.textContent = text);
      const button = document.createElement("button");
      button.textContent = text || `room ${index + 1}`;
      button.disabled = !room.eye;
      if (!room.eye) button.title = "No place to stand was found in this room";
      cell.append(button);
    });
    row.addEventListener("click", () => room.eye && enter(index));
    return row;
  });
  list.forEach((column, i) => {
    const cell = document.createElement("th"), button = document.createElement("button");
    button.textContent = column.head;
    if (!column.text) cell.className = "n";
    cell.append(button);
    head.append(cell);
    button.addEventListener("click", () => {
      const upward = cell.ariaSort !== "ascending", sign = upward ? 1 : -1;
      for (const other of head.cells) other.ariaSort = null;
      cell.ariaSort = upward ? "ascending" : "descending";
      const key = (row) => column.value(model.rooms[row.dataset.room]);
      rows.sort((a, b) => {
        const x = key(a), y = key(b), empty = (v) => v === undefined || v === null || v === "";
        if (empty(x) || empty(y)) return empty(x) - empty(y);
        return sign * (column.text ? x.localeCompare(y, undefined, { numeric: true }) : x - y);
      });
      body.append(...rows);
    });
  });
  return { mark: (index) => rows.forEach((row) => row.classList.toggle("here", Number(row.dataset.room) === index)) };
}

const path = (rings) => rings.map((ring) => {
  let d = "";
  for (let i = 0; i < ring.length; i += 2) d += `${i ? "L" : "M"}${ring[i].toFixed(3)} ${(-ring[i + 1]).toFixed(3)}`;
  return d + "Z";
}).join("");

/// True where (x, y) lies within the rings (even and odd crossings).
export function within(rings, x, y) {
  let inside = false;
  for (const ring of rings) {
    for (let i = 0, k = ring.length - 2; i < ring.length; k = i, i += 2) {
      const above = ring[i + 1] > y;
      if (above !== ring[k + 1] > y && x < ((ring[k] - ring[i]) * (y - ring[i + 1])) / (ring[k + 1] - ring[i + 1]) + ring[i]) inside = !inside;
    }
  }
  return inside;
}

/// The room around p, or -1.
export function roomAt(model, p, reach = 0.05) {
  return model.rooms.findIndex((room) =>
    p[2] > room.floor - reach && p[2] < room.floor + room.height + reach && within(room.rings, p[0], p[1]));
}

export class Plan {
  constructor(model, element, scale, enter) {
    Object.assign(this, { model, element, scale, enter, storey: -1 });
    this.eye = document.createElementNS(svg, "path");
    this.eye.setAttribute("class", "eye");
    element.classList.toggle("hidden", model.rooms.length === 0);
  }

  show(storey) {
    if (storey === this.storey || this.model.rooms.length === 0) return;
    this.storey = storey;
    const own = this.model.rooms.map((room, index) => ({ room, index })).filter(({ room }) => room.storey === storey);
    const flat = own.flatMap(({ room }) => room.rings.flat());
    const xs = flat.filter((_, i) => i % 2 === 0), ys = flat.filter((_, i) => i % 2 === 1);
    if (xs.length === 0) return this.element.replaceChildren();
    const box = [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
    this.size = Math.max(box[2] - box[0], box[3] - box[1]);
    const edge = 0.03 * this.size;
    this.element.setAttribute("viewBox", [box[0] - edge, -box[3] - edge, box[2] - box[0] + 2 * edge, box[3] - box[1] + 2 * edge].join(" "));
    this.shapes = own.map(({ room, index }) => {
      const shape = document.createElementNS(svg, "path"), title = document.createElementNS(svg, "title");
      shape.setAttribute("d", path(room.rings));
      shape.setAttribute("fill-rule", "evenodd");
      shape.dataset.room = index;
      const light = lightOf(room);
      title.textContent = `${room.name} ${room.longName}${light === undefined ? "" : `: ${shown(light)} ${this.model.unit}`}`;
      shape.append(title);
      if (room.eye) shape.addEventListener("click", () => this.enter(index));
      return shape;
    });
    this.element.replaceChildren(...this.shapes, this.eye);
    this.colour();
  }

  colour() {
    for (const shape of this.shapes ?? []) {
      const light = lightOf(this.model.rooms[shape.dataset.room]);
      shape.style.fill = light === undefined ? "none" : this.scale.colour(light);
    }
  }

  look(position, yaw) {
    const s = 0.035 * (this.size ?? 0);
    this.eye.setAttribute("d", `M${2 * s} 0L${-s} ${s}L${-0.4 * s} 0L${-s} ${-s}Z`);
    this.eye.setAttribute("transform", `translate(${position.x} ${-position.y}) rotate(${(-yaw * 180) / Math.PI})`);
  }
}
