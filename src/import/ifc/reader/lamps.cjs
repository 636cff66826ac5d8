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

/** A name as in a URL, where it is one. */
function decoded(name) {
  try { return decodeURIComponent(name); } catch { return name; }
}

/** A light source's intensities, as a scene has them but in candela for 1000 lumens of the lamp; undefined where it has none. */
function distributionOf(model, source) {
  const listed = list => [plain(list) ?? []].flat().map(Number);
  const data = model.line(plain(source.LightDistributionDataSource));
  const rows = [plain(data?.DistributionData) ?? []].flat().map(id => model.line(id)).filter(row => row)
    .map(row => ({plane: Number(plain(row.MainPlaneAngle)), angles: listed(row.SecondaryPlaneAngle), candela: listed(row.LuminousIntensity)}))
    .sort((a, b) => a.plane - b.plane);
  if (rows.length === 0) return undefined;
  // Many programs write degrees, whatever the unit that they name.
  const largest = Math.max(...rows.flatMap(row => [row.plane, ...row.angles]).map(Math.abs));
  const unit = (model.unitFactor('PLANEANGLEUNIT') ?? 1) * 180 / Math.PI;
  const inDegrees = Math.abs(unit - 1) < 1e-4 || largest * unit > 361;
  const degrees = angle => inDegrees ? angle : +(angle * unit).toFixed(4);
  return {type: /^TYPE_[ABC]$/.exec(plain(data.LightDistributionCurve))?.[0].slice(5) ?? 'C',
          planes: rows.map(row => degrees(row.plane)), angles: rows.map(row => row.angles.map(degrees)),
          candela: rows.map(row => row.candela)};
}

/** The axes of a placement: x, y, z by columns, in those of what it is placed in. */
function axesOf(model, position) {
  const ratios = reference => [plain(model.line(plain(reference))?.DirectionRatios) ?? []].flat().map(Number);
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const [axis, reference] = [ratios(position?.Axis), ratios(position?.RefDirection)];
  const z = axis.length === 3 ? axis : [0, 0, 1];
  const along = reference.length === 3 ? reference : Math.abs(z[0]) < 0.9 * Math.hypot(...z) ? [1, 0, 0] : [0, 1, 0];
  const unit = v => v.map(c => c / (Math.hypot(...v) || 1));
  const y = unit(cross(z, along));
  return {x: unit(cross(y, z)), y, z: unit(z)};
}

/** Light sources among a fixture's shapes: [{flux, at, axes, distribution, file}], at and axes in the fixture's own axes,
    undefined within a mapped shape; file: the name, without folder and ending, of the photometric file that it refers to. */
function sourcesOf(model, id, depth = 0) {
  const line = depth > 8 ? null : model.line(id);
  if (!line) return [];
  const list = value => [plain(value) ?? []].flat().filter(item => typeof item === 'number');
  if (typeof plain(line.LuminousFlux) === 'number') {
    const position = model.line(plain(line.Position)), point = model.line(plain(position?.Location));
    const location = plain(model.line(plain(line.LightDistributionDataSource))?.Location);
    return [{flux: plain(line.LuminousFlux), at: point ? plain(point.Coordinates).map(plain) : undefined,
             axes: axesOf(model, position), distribution: distributionOf(model, line),
             file: typeof location === 'string' ? decoded(location.replace(/^.*[\\/]/, '').replace(/\.\w+$/, '')) : undefined}];
  }
  const own = [line.Representation, line.Representations, line.Items].flatMap(list);
  const mapped = [line.MappingSource, line.MappedRepresentation].flatMap(list);
  return [...own.flatMap(item => sourcesOf(model, item, depth + 1)),
          ...mapped.flatMap(item => sourcesOf(model, item, depth + 1)).map(source => ({...source, at: undefined, axes: undefined}))];
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
    // All of a fixture's sources are one lamp: the first that tells a distribution speaks for them.
    const told = sources.find(source => source.distribution), {file} = sources.find(source => source.file) ?? {};
    // A fixture hangs along its own z axis, a light source along that of its placement in the fixture.
    const turned = ([x, y, z]) => [0, 1, 2].map(k => matrix[k] * x + matrix[4 + k] * y + matrix[8 + k] * z);
    const own = told?.axes ?? {y: [0, 1, 0], z: [0, 0, 1]};
    const axes = matrix ? {aim: turned(own.z).map(c => -c), up: turned(own.y)} : {};
    return {name, type: type ?? '', p: place, flux_lm: flux > 0 ? flux : 0, ...axes,
            ...(told ? {distribution: told.distribution} : {}), ...(file ? {file} : {})};
  }).filter(lamp => lamp.p);
}

module.exports = {luminairesOf};
