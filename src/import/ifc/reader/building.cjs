// What IFC says about the building beside its shapes: rooms, doors and windows, materials.
'use strict';

const {plain} = require('./model.cjs');
const {shapesOf, boundingBoxesOf, boxOf, floorOf} = require('./shapes.cjs');

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
    const space = model.line(id), parts = shapes.get(id) ?? boundingBoxesOf(model, id);
    const {corners, area} = floorOf(parts);
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

module.exports = {Storeys, roomsOf, portalsOf, opticsOf};
