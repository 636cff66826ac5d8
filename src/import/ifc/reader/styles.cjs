// What IFC's surface styles say beyond what web-ifc takes from them.
'use strict';

const ifc = require('web-ifc');
const {plain} = require('./model.cjs');

/** The diffuse colour of a rendering: a colour of its own, or the surface's times a ratio; undefined for neither.
    A ratio of 0 is what some programs write for none. */
function diffuseColour(model, rendering) {
  const rgb = id => {
    const line = model.line(id);
    return [line?.Red, line?.Green, line?.Blue].map(plain);
  };
  const diffuse = plain(rendering.DiffuseColour);
  if (!diffuse) return undefined;
  const isColour = rendering.DiffuseColour.type === ifc.REF;
  const colour = isColour ? rgb(diffuse) : rgb(plain(rendering.SurfaceColour)).map(c => c * diffuse);
  return colour.every(c => c >= 0 && c <= 1) ? colour : undefined;
}

/** Makes the diffuse colour of each rendering its surface colour, the only one that web-ifc shows. */
function showDiffuseColours(model) {
  let number = model.api.GetMaxExpressID(model.id);
  const real = value => model.api.CreateIfcType(model.id, ifc.IFCNORMALISEDRATIOMEASURE, value);
  for (const id of model.ids('IFCSURFACESTYLERENDERING')) {
    const rendering = model.line(id), colour = rendering && diffuseColour(model, rendering);
    if (!colour) continue;
    const entity = model.api.CreateIfcEntity(model.id, ifc.IFCCOLOURRGB, null, ...colour.map(real));
    entity.expressID = ++number;
    model.api.WriteLine(model.id, entity);
    rendering.SurfaceColour = {type: ifc.REF, value: number};
    model.api.WriteLine(model.id, rendering);
  }
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

module.exports = {colourTeller, showDiffuseColours};
