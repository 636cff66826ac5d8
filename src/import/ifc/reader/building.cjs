// What IFC says about the building beside its shapes: rooms, doors and windows, lamps, materials.
'use strict';

const {plain} = require('./model.cjs');
const {shapesOf, boxOf, floorOf} = require('./shapes.cjs');

/** Names of the storeys that products belong to, through whatever lies between. */
class Storeys {
  constructor(model) {
    this.model = model;
    this.above = model.relation('IFCRELCONTAINEDINSPATIALSTRUCTURE', 'RelatingStructure', 'RelatedElements');
    for (const [type, from, to] of [['IFCRELAGGREGATES', 'RelatingObject', 'RelatedObjects'],
                                    ['IFCRELNESTS', 'RelatingObject', 'RelatedObjects'],
                                    ['IFCRELVOIDSELEMENT', 'RelatingBuildingElement', 'RelatedOpeningElement'],
                                    ['IFCRELFILLSELEMENT', 'RelatingOpeningElement', 'RelatedBuildingElement']]) {
      for (const [id, parents] of model.relation(type, from, to))
        this.above.set(id, [...(this.above.get(id) ?? []), ...parents]);
    }
    this.storeys = new Set(model.ids('IFCBUILDINGSTOREY'));
  }
  nameOf(id) {
    const seen = new Set(), open = [id];
    while (open.length) {
      const next = open.shift();
      if (this.storeys.has(next)) return this.model.text(this.model.line(next)?.Name);
      if (seen.has(next)) continue;
      seen.add(next);
      open.push(...(this.above.get(next) ?? []));
    }
    return '';
  }
}

function roomsOf(model, storeys, warn) {
  const ids = model.ids('IFCSPACE');
  const shapes = shapesOf(model, ids);
  return ids.map(id => {
    const space = model.line(id), parts = shapes.get(id), {corners, area} = floorOf(parts);
    const name = model.text(space?.Name);
    if (!parts) warn(`room "${name}"`, 'has no shape: its place is not known');
    const told = model.number(id, n => /^net ?floor ?area$/i.test(n)) ?? model.number(id, n => /^gross ?floor ?area$/i.test(n));
    return {name, longName: model.text(space?.LongName), storey: storeys.nameOf(id), box: boxOf(parts), floor: corners,
            // Areas may be told in any unit; one that is far from the shape's is not in square metres.
            floorArea: told > 0.5 * area && told < 2 * area ? told : area, required_lx: model.number(id, (n, set) =>
                /^illuminance$/i.test(n) && /^pset_spacelighting/i.test(set)) ?? 0};
  });
}

/** The share of light that the glass of a door or window passes, where the model tells it. */
function glassOf(model, id, parts, optics) {
  const told = model.number(id, n => /^visible ?(light)? ?transmittance$/i.test(n)) ?? optics.get(id)?.transmittance;
  if (told !== undefined) return told;
  const clear = (parts ?? []).filter(part => (part.colour?.[3] ?? 1) < 0.5);
  return clear.length ? 1 - Math.max(...clear.map(part => part.colour[3])) : -1;
}

function portalsOf(model, shapes, optics) {
  const filled = model.relation('IFCRELFILLSELEMENT', 'RelatingOpeningElement', 'RelatedBuildingElement');
  const fillings = model.ids('IFCDOOR', 'IFCWINDOW');
  const inUse = new Set(fillings.flatMap(id => filled.get(id) ?? []));
  const bare = model.ids('IFCOPENINGELEMENT').filter(
      id => !inUse.has(id) && plain(model.line(id)?.PredefinedType) !== 'RECESS');
  const openings = shapesOf(model, [...bare, ...inUse]);
  const portal = (id, box, transmittance) =>
      ({kind: model.typeName(id), name: model.text(model.line(id)?.Name), box, transmittance});
  const found = fillings.map(id => portal(
      id, boxOf((filled.get(id) ?? []).flatMap(o => openings.get(o) ?? [])) ?? boxOf(shapes.get(id)),
      glassOf(model, id, shapes.get(id), optics)));
  return [...found, ...bare.map(id => portal(id, boxOf(openings.get(id)), -1))].filter(p => p.box);
}

/** Lamps and their fixtures. In IFC2x3 only their type tells a fixture from another terminal. */
function fixturesOf(model) {
  const found = model.ids('IFCLIGHTFIXTURE', 'IFCLAMP');
  for (const id of model.ids('IFCFLOWTERMINAL')) {
    const types = (model.types.get(id) ?? []).map(type => model.typeName(type));
    if (types.some(type => /^Ifc(LightFixture|Lamp)Type$/.test(type))) found.push(id);
  }
  return [...new Set(found)];
}

const prefixes = {EXA: 1e18, PETA: 1e15, TERA: 1e12, GIGA: 1e9, MEGA: 1e6, KILO: 1e3, HECTO: 1e2, DECA: 10, DECI: 0.1,
                  CENTI: 1e-2, MILLI: 1e-3, MICRO: 1e-6, NANO: 1e-9};

/** Metres in the model's unit of length. Shapes come in metres; places of products do not. */
function metresPerUnit(model) {
  const metres = unit => {
    const factor = model.line(plain(model.line(unit)?.ConversionFactor));
    if (factor) return Number(plain(factor.ValueComponent)) * metres(plain(factor.UnitComponent));
    return prefixes[plain(model.line(unit)?.Prefix)] ?? 1;
  };
  for (const id of model.ids('IFCUNITASSIGNMENT')) {
    const unit = [plain(model.line(id)?.Units) ?? []].flat().find(u => plain(model.line(u)?.UnitType) === 'LENGTHUNIT');
    if (unit) return metres(unit);
  }
  return 1;
}

const fluxNames = /^(total|contributed|initial)? ?(luminous|lamp|luminaire)? ?(luminous)? ?flux$|^lichtstrom$|^lumens?$/i;

/** Luminous flux of the light sources among a fixture's shapes, lm. */
function sourceFlux(model, id, depth = 0) {
  if (depth > 8) return 0;
  const line = model.line(id);
  if (!line) return 0;
  if (typeof plain(line.LuminousFlux) === 'number') return plain(line.LuminousFlux);
  const below = [line.Representation, line.Representations, line.Items, line.MappingSource, line.MappedRepresentation]
      .flatMap(value => [plain(value) ?? []].flat()).filter(value => typeof value === 'number');
  return below.reduce((sum, item) => sum + sourceFlux(model, item, depth + 1), 0);
}

function luminairesOf(model, shapes, warn) {
  const metres = metresPerUnit(model);
  return fixturesOf(model).map(id => {
    const line = model.line(id), name = model.text(line?.Name), box = boxOf(shapes.get(id));
    const type = (model.types.get(id) ?? []).map(t => model.text(model.line(t)?.Name))[0] ?? model.text(line?.ObjectType);
    const flux = model.number(id, n => fluxNames.test(n)) ?? sourceFlux(model, id);
    const placed = typeof plain(line?.ObjectPlacement) === 'number' &&
        model.api.GetWorldTransformMatrix(model.id, plain(line.ObjectPlacement));
    let place = box && [(box[0][0] + box[1][0]) / 2, (box[0][1] + box[1][1]) / 2, box[0][2] - 0.01];
    if (!place && placed) place = [metres * placed[12], metres * placed[13], metres * placed[14]];
    if (!place) warn(`lamp "${name}"`, 'has neither a shape nor a place: left out');
    // A fixture hangs along its own z axis.
    const axes = placed ? {aim: [-placed[8], -placed[9], -placed[10]], up: [placed[4], placed[5], placed[6]]} : {};
    return {name, type: type ?? '', p: place, flux_lm: flux > 0 ? flux : 0, ...axes};
  }).filter(lamp => lamp.p);
}

/** {reflectance, transmittance} for light, by product, where its material tells them. */
function opticsOf(model) {
  const ofMaterial = new Map();
  const note = (material, name, value) => {
    if (typeof material !== 'number' || typeof value !== 'number') return;
    const entry = ofMaterial.get(material) ?? {};
    if (/^visible ?transmittance$/i.test(name)) entry.transmittance = value;
    if (/^visible ?reflectance ?(front)?$/i.test(name)) entry.reflectance = value;
    ofMaterial.set(material, entry);
  };
  for (const id of model.ids('IFCMATERIALPROPERTIES')) {  // IFC2x3: IfcOpticalMaterialProperties; IFC4: property sets
    const line = model.line(id), material = plain(line?.Material);
    note(material, 'VisibleTransmittance', plain(line?.VisibleTransmittance));
    note(material, 'VisibleReflectanceFront', plain(line?.VisibleReflectanceFront));
    for (const member of [plain(line?.Properties ?? line?.ExtendedProperties) ?? []].flat()) {
      const property = model.line(member);
      note(material, model.text(property?.Name), plain(property?.NominalValue));
    }
  }
  const optics = new Map();
  if (!ofMaterial.size) return optics;
  const used = model.relation('IFCRELASSOCIATESMATERIAL', 'RelatingMaterial', 'RelatedObjects');
  for (const [product, materials] of used) {
    const found = ofMaterial.get(materials[0]);
    if (found) optics.set(product, found);
  }
  return optics;
}

/** Tells whether a product has a colour of its own or of its material; web-ifc shows the others white. */
function colourTeller(model) {
  const styled = new Set(model.ids('IFCSTYLEDITEM').map(id => plain(model.line(id)?.Item)));
  const coloured = new Set(model.ids('IFCMATERIALDEFINITIONREPRESENTATION').map(
      id => plain(model.line(id)?.RepresentedMaterial)));
  const materials = coloured.size ?
      model.relation('IFCRELASSOCIATESMATERIAL', 'RelatingMaterial', 'RelatedObjects') : new Map();
  const below = (id, keys, fits, depth = 0) => {
    if (fits(id)) return true;
    const line = depth < 12 ? model.line(id) : null;
    return keys.flatMap(key => [plain(line?.[key]) ?? []].flat())
        .some(next => typeof next === 'number' && below(next, keys, fits, depth + 1));
  };
  const shapeKeys = ['Representation', 'Representations', 'Items', 'MappingSource', 'MappedRepresentation',
                     'FirstOperand', 'SecondOperand'];
  const materialKeys = ['ForLayerSet', 'MaterialLayers', 'Material', 'Materials', 'MaterialConstituents',
                        'ForProfileSet', 'MaterialProfiles'];
  return id => below(id, shapeKeys, item => styled.has(item)) ||
      [id, ...(model.types.get(id) ?? [])].flatMap(user => materials.get(user) ?? [])
          .some(material => below(material, materialKeys, item => coloured.has(item)));
}

module.exports = {colourTeller, Storeys, roomsOf, portalsOf, luminairesOf, opticsOf};
