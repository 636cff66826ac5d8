// Light fixtures of IFC models: where they are, and their luminous flux.
'use strict';

const {plain} = require('./model.cjs');
const {boxOf} = require('./shapes.cjs');

/** Lamps and their fixtures. In IFC2x3 only their type tells a fixture from another terminal. */
function fixturesOf(model) {
  const found = model.ids('IFCLIGHTFIXTURE', 'IFCLAMP');
  for (const id of model.ids('IFCFLOWTERMINAL')) {
    const types = (model.types.get(id) ?? []).map(type => model.typeName(type));
    if (types.some(type => /^Ifc(LightFixture|Lamp)Type$/.test(type))) found.push(id);
  }
  return [...new Set(found)];
}

const fluxNames = /^(total|contributed|initial)? ?(luminous|lamp|luminaire)? ?(luminous)? ?flux$|^lichtstrom$|^lumens?$/i;

/** Light sources among a fixture's shapes: [{flux, at}], at in the fixture's own axes; undefined within a mapped shape. */
function sourcesOf(model, id, depth = 0) {
  const line = depth > 8 ? null : model.line(id);
  if (!line) return [];
  const list = value => [plain(value) ?? []].flat().filter(item => typeof item === 'number');
  if (typeof plain(line.LuminousFlux) === 'number') {
    const point = model.line(plain(model.line(plain(line.Position))?.Location));
    return [{flux: plain(line.LuminousFlux), at: point ? plain(point.Coordinates).map(plain) : undefined}];
  }
  const own = [line.Representation, line.Representations, line.Items].flatMap(list);
  const mapped = [line.MappingSource, line.MappedRepresentation].flatMap(list);
  return [...own.flatMap(item => sourcesOf(model, item, depth + 1)),
          ...mapped.flatMap(item => sourcesOf(model, item, depth + 1)).map(({flux}) => ({flux}))];
}

/** Where a lamp shines from: below its shape, so that it does not stand in its own body; else where its light sources are,
    or the fixture. */
function placeOf(model, box, matrix, sources) {
  if (box) return [(box[0][0] + box[1][0]) / 2, (box[0][1] + box[1][1]) / 2, box[0][2] - 0.01];
  if (!matrix) return undefined;
  const told = sources.filter(source => source.at);
  const middle = [0, 1, 2].map(k => told.reduce((sum, {at}) => sum + at[k], 0) / Math.max(1, told.length));
  return model.worldPoint(matrix, middle);
}

function luminairesOf(model, shapes, warn) {
  for (const id of model.ids('IFCLIGHTSOURCE')) {
    const line = model.line(id);
    if (typeof plain(line?.LuminousFlux) !== 'number')
      warn(`${model.typeName(id)} "${model.text(line?.Name)}"`, 'tells no luminous flux: left out');
  }
  return fixturesOf(model).map(id => {
    const line = model.line(id), name = model.text(line?.Name), box = boxOf(shapes.get(id));
    const type = (model.types.get(id) ?? []).map(t => model.text(model.line(t)?.Name))[0] ?? model.text(line?.ObjectType);
    const sources = sourcesOf(model, id), matrix = model.placement(id);
    const flux = model.number(id, n => fluxNames.test(n)) ?? sources.reduce((sum, source) => sum + source.flux, 0);
    const place = placeOf(model, box, matrix, sources);
    if (!place) warn(`lamp "${name}"`, 'has neither a shape nor a place: left out');
    // A fixture hangs along its own z axis.
    const axes = matrix ? {aim: [-matrix[8], -matrix[9], -matrix[10]], up: [matrix[4], matrix[5], matrix[6]]} : {};
    return {name, type: type ?? '', p: place, flux_lm: flux > 0 ? flux : 0, ...axes};
  }).filter(lamp => lamp.p);
}

module.exports = {luminairesOf};
