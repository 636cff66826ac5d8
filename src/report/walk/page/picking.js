// What lies under the pointer, and the light there as the solution has it.
import { oneValue } from "./model.js";

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

export class Picker {
  constructor(model, light) {
    this.model = model;
    this.light = light;
    this.normals = new Float32Array(3 * model.polygons);
    this.boxes = new Float32Array(4 * model.polygons);  // of the points, along u and v
    for (let k = 0; k < model.polygons; ++k) {
      this.normals.set(cross(model.frames.subarray(9 * k + 3, 9 * k + 6), model.frames.subarray(9 * k + 6, 9 * k + 9)), 3 * k);
      const box = [Infinity, Infinity, -Infinity, -Infinity];
      for (let p = model.firstPoint[k]; p < model.firstPoint[k + 1]; ++p) {
        for (let c = 0; c < 2; ++c) {
          box[c] = Math.min(box[c], model.points[2 * p + c]);
          box[2 + c] = Math.max(box[2 + c], model.points[2 * p + c]);
        }
      }
      this.boxes.set(box, 4 * k);
    }
  }

  /// The first surface along a ray (arrays of three numbers), of those that `view` shows: {storeys, outside, backs, cut}.
  /// `front` is false for a back, which has no light.
  pick(from, direction, view) {
    const { model, normals, boxes } = this, f = model.frames;
    let best = null, nearest = Infinity;
    for (let k = 0; k < model.polygons; ++k) {
      const n = 3 * k, o = 9 * k;
      const toward = direction[0] * normals[n] + direction[1] * normals[n + 1] + direction[2] * normals[n + 2];
      if (toward === 0 || (toward > 0 && !view.backs)) continue;
      const away = [f[o] - from[0], f[o + 1] - from[1], f[o + 2] - from[2]];
      const t = (away[0] * normals[n] + away[1] * normals[n + 1] + away[2] * normals[n + 2]) / toward;
      if (!(t > 1e-6) || t >= nearest) continue;
      if (!(view.storeys >>> Math.min(model.storey[k], 31) & 1) || (model.outside[k] && !view.outside)) continue;
      const d = [0, 1, 2].map((c) => t * direction[c] - away[c]);
      const x = d[0] * f[o + 3] + d[1] * f[o + 4] + d[2] * f[o + 5], y = d[0] * f[o + 6] + d[1] * f[o + 7] + d[2] * f[o + 8];
      if (x < boxes[4 * k] || y < boxes[4 * k + 1] || x > boxes[4 * k + 2] || y > boxes[4 * k + 3]) continue;
      if (from[2] + t * direction[2] > view.cut) continue;
      const at = this.faceAt(k, x, y);
      if (at === null) continue;
      nearest = t;
      best = { polygon: k, front: toward < 0, ...at, distance: t, p: [0, 1, 2].map((c) => from[c] + t * direction[c]) };
    }
    return best && { ...best, normal: [...normals.subarray(3 * best.polygon, 3 * best.polygon + 3)] };
  }

  point(polygon, corner) {
    const p = 2 * (this.model.firstPoint[polygon] + this.model.corners[corner]);
    return [this.model.points[p], this.model.points[p + 1]];
  }

  /// The face of a polygon that (x, y) lies in, and the triangle of its fan: {face, i, weights}. Null outside of all.
  faceAt(polygon, x, y) {
    const { firstFace, firstCorner, middles } = this.model;
    for (let face = firstFace[polygon]; face < firstFace[polygon + 1]; ++face) {
      const first = firstCorner[face], count = firstCorner[face + 1] - first;
      const m = [middles[2 * face], middles[2 * face + 1]];
      for (let i = 0; i < count; ++i) {
        const a = this.point(polygon, first + i), b = this.point(polygon, first + (i + 1) % count);
        const area = (a[0] - m[0]) * (b[1] - m[1]) - (a[1] - m[1]) * (b[0] - m[0]);
        if (!(area > 0)) continue;
        const ofA = ((x - m[0]) * (b[1] - m[1]) - (y - m[1]) * (b[0] - m[0])) / area;
        const ofB = ((a[0] - m[0]) * (y - m[1]) - (a[1] - m[1]) * (x - m[0])) / area;
        if (ofA > -1e-4 && ofB > -1e-4 && ofA + ofB < 1 + 1e-4) return { face, i, weights: [ofA, ofB, 1 - ofA - ofB] };
      }
    }
    return null;
  }

  /// Irradiance and radiosity where a ray has met a front, as one value each, by the face's own patch.
  lightAt(hit) {
    const { model, light } = this, n = model.channels;
    const first = model.firstCorner[hit.face] + hit.face;
    const count = model.firstCorner[hit.face + 1] - model.firstCorner[hit.face];
    const vertices = [first + hit.i, first + (hit.i + 1) % count, first + count];
    const irradiance = [], radiosity = [];
    for (let c = 0; c < n; ++c) {
      irradiance.push(vertices.reduce((sum, v, k) => sum + hit.weights[k] * light.own[v * n + c], 0));
      radiosity.push(light.emission(hit.polygon) * model.exitance[hit.polygon * n + c] +
        model.reflectance[hit.polygon * n + c] * irradiance[c]);
    }
    return { irradiance: oneValue(model, irradiance), radiosity: oneValue(model, radiosity) };
  }
}
