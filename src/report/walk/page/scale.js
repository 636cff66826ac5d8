// The scale of false colours, its legend, and what it spans at first.
import { oneValue, shown } from "./model.js";

/// The largest or smallest of 1, 2, 5 times a power of ten on the given side of x.
function round125(x, upward) {
  const decade = 10 ** Math.floor(Math.log10(x));
  const steps = [1, 2, 5, 10].map((s) => s * decade);
  return upward ? steps.find((s) => s >= x * (1 - 1e-9)) : steps.filter((s) => s <= x * (1 + 1e-9)).pop();
}

/// The area of a face, from the fan about its centroid.
function areaOf(model, polygon, face) {
  const first = model.firstCorner[face], count = model.firstCorner[face + 1] - first;
  const point = (i) => 2 * (model.firstPoint[polygon] + model.corners[first + (i % count)]), { points: p, middles: m } = model;
  let sum = 0;
  for (let i = 0; i < count; ++i) {
    const a = point(i), b = point(i + 1);
    sum += (p[a] - m[2 * face]) * (p[b + 1] - m[2 * face + 1]) - (p[a + 1] - m[2 * face + 1]) * (p[b] - m[2 * face]);
  }
  return 0.5 * sum;
}

/// Between the 2% darkest and the 0.5% brightest of the area of rooms of the building, at most four decades.
export function usualScale(model, light) {
  const values = [], n = model.channels;
  for (let polygon = 0; polygon < model.polygons; ++polygon) {
    if (model.outside[polygon]) continue;
    for (let face = model.firstFace[polygon]; face < model.firstFace[polygon + 1]; ++face) {
      const middle = (model.firstCorner[face + 1] + face) * n;
      const e = oneValue(model, light.own.subarray(middle, middle + n));
      if (e > 0) values.push([e, areaOf(model, polygon, face)]);
    }
  }
  if (values.length === 0) return { lowest: 0.1, highest: 1 };
  values.sort((a, b) => a[0] - b[0]);
  const whole = values.reduce((sum, v) => sum + v[1], 0);
  const below = (share) => {
    let sum = 0;
    return values.find((v) => (sum += v[1]) >= share * whole)?.[0] ?? values[values.length - 1][0];
  };
  const highest = round125(below(0.995), true);
  const low = Math.max(below(0.02), 1e-4 * highest);
  return { lowest: Math.min(round125(low, false), 0.1 * highest), highest };
}

export class Scale {
  constructor(model, element) {
    Object.assign(this, { palette: model.palette, unit: model.unit, element, lowest: 1, highest: 1000, logarithmic: true, steps: 0 });
  }

  position(value) {
    const { lowest: a, highest: b } = this;
    const t = this.logarithmic ? Math.log(Math.max(value, a) / a) / Math.log(b / a) : (value - a) / (b - a);
    return Math.max(0, Math.min(1, t));
  }

  colour(value) {
    let t = this.position(value);
    if (this.steps > 0) t = (Math.floor(Math.min(t * this.steps, this.steps - 0.001)) + 0.5) / this.steps;
    const at = t * (this.palette.length - 1), i = Math.min(Math.floor(at), this.palette.length - 2);
    const mix = this.palette[i].map((c, k) => Math.round(c + (at - i) * (this.palette[i + 1][k] - c)));
    return `rgb(${mix.join(",")})`;
  }

  /// Where each step begins and ends, or round numbers.
  ticks() {
    if (this.steps > 0) {
      return Array.from({ length: this.steps + 1 }, (_, i) => {
        const t = i / this.steps;
        return this.logarithmic ? this.lowest * (this.highest / this.lowest) ** t : this.lowest + t * (this.highest - this.lowest);
      });
    }
    const at = [];
    if (this.logarithmic) {
      for (let v = round125(this.lowest, true); v <= this.highest * (1 + 1e-9); v = round125(v * 1.5, true)) at.push(v);
    } else {
      const step = round125((this.highest - this.lowest) / 8, true);
      for (let v = Math.ceil(this.lowest / step) * step; v <= this.highest * (1 + 1e-9); v += step) at.push(v);
    }
    return at;
  }

  draw() {
    const stops = Array.from({ length: 65 }, (_, i) => {
      const t = i / 64;
      const v = this.logarithmic ? this.lowest * (this.highest / this.lowest) ** t : this.lowest + t * (this.highest - this.lowest);
      return `${this.colour(v)} ${(100 * t).toFixed(1)}%`;
    });
    const ticks = this.ticks(), every = Math.ceil(ticks.length / 9);
    this.element.querySelector(".bar").style.background = `linear-gradient(to right,${stops.join(",")})`;
    this.element.querySelector(".ticks").replaceChildren(...ticks.filter((_, i) => i % every === 0).map((v) => {
      const tick = document.createElement("span");
      tick.textContent = shown(v);
      tick.style.left = `${100 * this.position(v)}%`;
      return tick;
    }));
    this.element.querySelector(".unit").textContent = this.unit;
  }
}
