// node read_ifc.cjs < model.ifc > model.json: an IFC model (2x3, 4, 4.3) as triangles, rooms, portals and luminaires.
// The answer is one JSON document: {"schema", "elements", "rooms", "portals", "luminaires", "warnings"}, or {"fault"}.
'use strict';

const fs = require('fs');

function answer(document) {
  fs.writeFileSync(1, JSON.stringify(document));
}

/** Products that stand for no matter. */
const withoutMatter = ['IFCSPACE', 'IFCOPENINGELEMENT', 'IFCANNOTATION', 'IFCGRID', 'IFCSPATIALZONE',
                       'IFCVIRTUALELEMENT', 'IFCPORT', 'IFCSTRUCTURALITEM', 'IFCSTRUCTURALACTIVITY'];

async function read(bytes) {
  const {IfcAPI, LogLevel} = require('web-ifc');
  const {Model, plain} = require('./model.cjs');
  const {shapesOf} = require('./shapes.cjs');
  const {brokenEntities} = require('./step_text.cjs');
  const {Storeys, roomsOf, portalsOf, opticsOf} = require('./building.cjs');
  const {luminairesOf} = require('./lamps.cjs');
  const {colourTeller, showDiffuseColours} = require('./styles.cjs');

  const api = new IfcAPI();
  await api.Init();
  api.SetLogLevel(LogLevel.LOG_LEVEL_OFF);
  const model = new Model(api, bytes);
  const warnings = [], warn = (where, what) => warnings.push([where, what]);

  // What cannot be read beside the shapes costs no more than itself.
  const attempt = (what, find) => {
    try {
      return find();
    } catch {
      warn(what, 'cannot be read from this model: left out');
      return [];
    }
  };
  if (!bytes.subarray(-4096).includes('END-ISO-10303-21'))
    warn('file', 'ends before END-ISO-10303-21: it is cut off, and what is missing is not known');
  const broken = brokenEntities(bytes);
  const skipped = new Set(model.ids(...withoutMatter));
  const products = model.ids('IFCPRODUCT').filter(id => !skipped.has(id));
  const label = id => `${model.typeName(id)} "${model.text(model.line(id)?.Name)}"`;
  const shaped = products.filter(id => {
    const line = model.line(id);
    const missing = [line?.Representation, line?.ObjectPlacement].map(v => broken.get(plain(v))).find(Boolean);
    if (missing) warn(label(id), `leads to #${missing}, which is not in the file: left out`);
    return !missing && typeof plain(line?.Representation) === 'number';
  });
  attempt('surface styles', () => showDiffuseColours(model));
  const shapes = shapesOf(model, shaped), optics = opticsOf(model), storeys = new Storeys(model);
  const hasColour = colourTeller(model), isWhite = part => part.colour.every(c => c === 1);
  const elements = [];
  for (const id of shaped) {
    const parts = shapes.get(id);
    if (!parts) {
      if (hasBody(model, id)) warn(label(id), 'has a shape that cannot be made: left out');
      continue;
    }
    if (parts.some(isWhite) && !hasColour(id)) parts.filter(isWhite).forEach(part => { part.colour = null; });
    const storey = storeys.nameOf(id), {reflectance, transmittance} = optics.get(id) ?? {};
    elements.push({type: model.typeName(id), name: model.text(model.line(id)?.Name),
                   object: `${model.typeName(id)}/${id}${storey ? '@' + storey : ''}`, reflectance, transmittance, parts});
  }
  return {schema: model.schema, elements, rooms: attempt('rooms', () => roomsOf(model, storeys, warn)),
          portals: attempt('portals', () => portalsOf(model, shapes, optics)),
          luminaires: attempt('luminaires', () => luminairesOf(model, shapes, warn)), warnings};
}

/** True where a product is more than an axis, a plan or a light source: it has a body, or a surface. */
function hasBody(model, id) {
  const {plain} = require('./model.cjs');
  const shape = model.line(plain(model.line(id)?.Representation));
  return [plain(shape?.Representations) ?? []].flat().some(representation =>
      /^(body|facetation|surface|tessellation|mesh)/i.test(model.text(model.line(representation)?.RepresentationIdentifier)));
}

async function main() {
  try {
    require.resolve('web-ifc');
  } catch {
    return answer({fault: 'no web-ifc'});
  }
  const bytes = fs.readFileSync(0);
  if (!bytes.subarray(0, 4096).includes('ISO-10303-21')) return answer({fault: 'no STEP file'});
  const schema = /FILE_SCHEMA\s*\(\s*\(\s*'([^']*)'/i.exec(bytes.subarray(0, 1 << 16).toString('latin1'));
  if (!schema || !/^IFC(2X3|4)/i.test(schema[1])) return answer({fault: 'no known schema'});
  const malformed = require('./step_text.cjs').malformedEntity(bytes);
  answer(malformed ? {fault: 'malformed', ...malformed} : await read(bytes));
}

main().catch(error => answer({fault: 'cannot be read', detail: String(error?.message ?? error)}));
