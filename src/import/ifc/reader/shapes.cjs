// Triangles of IFC's products, in metres, z up, in the axes of the world.
'use strict';

const {plain} = require('./model.cjs');

/** web-ifc turns models to y up; this turns them back. Float32 leaves no more than 0.01 mm. */
function worldPoint(m, x, y, z) {
  const round = value => Math.round(value * 1e5) / 1e5 + 0;
  return [round(m[0] * x + m[4] * y + m[8] * z + m[12]),
          round(-(m[2] * x + m[6] * y + m[10] * z + m[14])),
          round(m[1] * x + m[5] * y + m[9] * z + m[13])];
}

/** Parts of one mesh: {colour: [r, g, b, alpha], points: [x, y, z, ...], triangles: [a, b, c, ...]}. */
function partsOf(model, mesh) {
  const parts = [];
  for (let i = 0; i < mesh.geometries.size(); ++i) {
    const placed = mesh.geometries.get(i);
    const geometry = model.api.GetGeometry(model.id, placed.geometryExpressID);
    const vertices = model.api.GetVertexArray(geometry.GetVertexData(), geometry.GetVertexDataSize());
    const indices = model.api.GetIndexArray(geometry.GetIndexData(), geometry.GetIndexDataSize());
    const points = [];
    for (let v = 0; v + 5 < vertices.length; v += 6)  // a place and a normal
      points.push(...worldPoint(placed.flatTransformation, vertices[v], vertices[v + 1], vertices[v + 2]));
    const {x, y, z, w} = placed.color;
    if (indices.length) parts.push({colour: [x, y, z, w], points, triangles: Array.from(indices)});
    geometry.delete();
  }
  return parts;
}

/** Parts of these products, by their id; a product without a shape that can be made is not there. */
function shapesOf(model, ids) {
  const shapes = new Map();
  for (const id of ids) {
    try {
      model.api.StreamMeshes(model.id, [id], mesh => {
        const parts = partsOf(model, mesh);
        if (parts.length) shapes.set(mesh.expressID, [...(shapes.get(mesh.expressID) ?? []), ...parts]);
      });
    } catch { /* told by the caller, as a product without a shape */ }
  }
  return shapes;
}

/** [[low x, y, z], [high x, y, z]] of parts; undefined for none. */
function boxOf(parts) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const part of parts ?? []) {
    for (let i = 0; i < part.points.length; ++i) {
      low[i % 3] = Math.min(low[i % 3], part.points[i]);
      high[i % 3] = Math.max(high[i % 3], part.points[i]);
    }
  }
  return low[0] <= high[0] ? [low, high] : undefined;
}

/** Area of a ring of [x, y], above 0 where it runs counter-clockwise. */
function ringArea(ring) {
  let twice = 0;
  ring.forEach(([x, y], i) => {
    const [u, v] = ring[(i + 1) % ring.length];
    twice += x * v - u * y;
  });
  return twice / 2;
}

/** Corners of the triangles of a room's floor, [x, y, ...] without order; their area. */
function floorOf(parts) {
  const box = boxOf(parts), corners = [];
  let area = 0;
  for (const {points, triangles} of box ? parts : []) {
    for (let t = 0; t < triangles.length; t += 3) {
      const at = [0, 1, 2].map(k => points.slice(3 * triangles[t + k], 3 * triangles[t + k] + 3));
      if (at.some(p => p[2] > box[0][2] + 1e-3)) continue;
      area += Math.abs(ringArea(at));
      corners.push(...at.flatMap(p => p.slice(0, 2)));
    }
  }
  return {corners, area};
}

/** The bounding boxes (IfcBoundingBox) among a product's representations as parts, which web-ifc does not show. */
function boundingBoxesOf(model, id) {
  const list = value => [plain(value) ?? []].flat();
  const matrix = model.placement(id);
  const shape = model.line(plain(model.line(id)?.Representation));
  const items = list(shape?.Representations).flatMap(r => list(model.line(r)?.Items));
  const boxes = items.map(item => model.line(item)).filter(line => line?.XDim !== undefined && line?.Corner !== undefined);
  if (!matrix || !boxes.length) return undefined;
  const parts = boxes.flatMap(box => {
    const low = (plain(model.line(plain(box.Corner))?.Coordinates) ?? []).map(plain);
    if (low.length !== 3) return [];
    const size = [box.XDim, box.YDim, box.ZDim].map(plain);
    const points = [0, 1, 2, 3, 4, 5, 6, 7].flatMap(
        i => model.worldPoint(matrix, low.map((x, k) => x + (i >> k & 1) * size[k])));
    const sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
    return [{points, triangles: sides.flatMap(([a, b, c, d]) => [a, b, c, a, c, d])}];
  });
  return parts.length ? parts : undefined;
}

module.exports = {shapesOf, boundingBoxesOf, boxOf, floorOf};
