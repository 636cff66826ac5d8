// An open IFC model: entities as plain values, relations between them, and property sets.
'use strict';

const ifc = require('web-ifc');

const inSchemaCase = new Map();
for (const schema of [ifc.IFC2X3, ifc.IFC4, ifc.IFC4X3]) {
  for (const name of Object.keys(schema ?? {})) inSchemaCase.set(name.toUpperCase(), name);
}

/** A value without web-ifc's wrapper: {value, type} becomes value, a reference its number. */
function plain(value) {
  if (Array.isArray(value)) return value.map(plain);
  return value !== null && typeof value === 'object' && 'value' in value ? value.value : value;
}

const prefixes = {EXA: 1e18, PETA: 1e15, TERA: 1e12, GIGA: 1e9, MEGA: 1e6, KILO: 1e3, HECTO: 1e2, DECA: 10, DECI: 0.1,
                  CENTI: 1e-2, MILLI: 1e-3, MICRO: 1e-6, NANO: 1e-9};

class Model {
  constructor(api, bytes) {
    this.api = api;
    this.id = api.OpenModel(bytes, {COORDINATE_TO_ORIGIN: false, CIRCLE_SEGMENTS: 32});
    if (this.id < 0) throw new Error('cannot be opened');
    this.schema = api.GetModelSchema(this.id);
  }

  /** Entity `id`; null where it cannot be read. */
  line(id) {
    try { return this.api.GetLine(this.id, id) ?? null; } catch { return null; }
  }
  /** Ids of all entities of these types and of what is derived from them. */
  ids(...names) {
    const found = [];
    for (const name of names) {
      const type = ifc[name];
      if (type === undefined) continue;
      const list = this.api.GetLineIDsWithType(this.id, type, true);
      for (let i = 0; i < list.size(); ++i) found.push(list.get(i));
    }
    return [...new Set(found)];
  }
  /** "IfcWallStandardCase". */
  typeName(id) {
    const name = this.api.GetNameFromTypeCode(this.api.GetLineType(this.id, id)) ?? '';
    return inSchemaCase.get(String(name).toUpperCase()) ?? String(name);
  }
  text(value) {
    const found = plain(value);
    return typeof found === 'string' ? found : '';
  }

  /** Map from each related entity to what relates it, of one type of relation. */
  relation(type, relating, related) {
    const found = new Map();
    for (const id of this.ids(type)) {
      const relation = this.line(id);
      const from = plain(relation?.[relating]);
      for (const to of [plain(relation?.[related])].flat()) {
        if (typeof from !== 'number' || typeof to !== 'number') continue;
        if (!found.has(to)) found.set(to, []);
        found.get(to).push(from);
      }
    }
    return found;
  }

  /** Metres in the model's unit of length. Shapes come in metres; places of products do not. */
  get metresPerUnit() { return this.metres ??= this.unitFactor('LENGTHUNIT') ?? 1; }
  /** A unit of the model in units of the SI (metres, radians); undefined where the model names none. */
  unitFactor(type) {
    const factorOf = unit => {
      const factor = this.line(plain(this.line(unit)?.ConversionFactor));
      if (factor) return Number(plain(factor.ValueComponent)) * factorOf(plain(factor.UnitComponent));
      return prefixes[plain(this.line(unit)?.Prefix)] ?? 1;
    };
    for (const id of this.ids('IFCUNITASSIGNMENT')) {
      const unit = [plain(this.line(id)?.Units) ?? []].flat().find(u => plain(this.line(u)?.UnitType) === type);
      if (unit) return factorOf(unit);
    }
    return undefined;
  }

  /** The matrix from a product's own axes to the world's, by columns, in the model's unit; undefined where it has no place. */
  placement(id) {
    const place = plain(this.line(id)?.ObjectPlacement);
    return typeof place === 'number' ? this.api.GetWorldTransformMatrix(this.id, place) : undefined;
  }
  /** A point of a product's own axes (x, y, z; the model's unit) in the world, m. */
  worldPoint(matrix, [x, y, z]) {
    return [0, 1, 2].map(k => this.metresPerUnit * (matrix[k] * x + matrix[4 + k] * y + matrix[8 + k] * z + matrix[12 + k]));
  }

  get types() { return this.typesOf ??= this.relation('IFCRELDEFINESBYTYPE', 'RelatingType', 'RelatedObjects'); }
  get propertySets() {
    return this.propertySetsOf ??=
        this.relation('IFCRELDEFINESBYPROPERTIES', 'RelatingPropertyDefinition', 'RelatedObjects');
  }

  /** Numbers and words of the property sets and quantities of an object and of its type:
      [[set, name, value], ...], the object's own first. */
  properties(id) {
    const found = [];
    const sets = [...(this.propertySets.get(id) ?? [])];
    for (const type of this.types.get(id) ?? [])
      sets.push(...[plain(this.line(type)?.HasPropertySets) ?? []].flat());
    for (const set of sets) {
      const definition = this.line(set);
      const name = this.text(definition?.Name);
      const members = definition?.HasProperties ?? definition?.Quantities ?? [];
      for (const member of [plain(members)].flat()) {
        const property = this.line(member);
        const value = plain(property?.NominalValue ?? property?.AreaValue ?? property?.LengthValue);
        if (value !== null && value !== undefined) found.push([name, this.text(property.Name), value]);
      }
    }
    return found;
  }
  /** The first number among the properties whose name fits. */
  number(id, fits) {
    for (const [set, name, value] of this.properties(id)) {
      if (fits(name, set) && Number.isFinite(Number(value)) && value !== '') return Number(value);
    }
    return undefined;
  }
}

module.exports = {Model, plain};
