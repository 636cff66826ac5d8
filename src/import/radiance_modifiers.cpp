#include "import/radiance_modifiers.hpp"

#include "json/json_text.hpp"

namespace enfilade {

RadianceModifiers::Link RadianceModifiers::find(const std::string& name,
                                                const RadiancePrimitive& user) const {
  if (name == "void") return {};
  const auto it = by_name_.find(name);
  if (it == by_name_.end()) {
    user.place.fail(user.label() + " names " + radiance_quoted(name) + ", which is not defined",
                    "define it before its use; where materials have a file of their own, join the "
                    "two (cat materials.rad room.rad > all.rad)");
  }
  return it->second;
}

void RadianceModifiers::define(const RadiancePrimitive& primitive) {
  Modifier modifier;
  if (primitive.kind == RadianceKind::alias) {
    const Link original = find(primitive.words[0], primitive);
    if (!original) primitive.place.fail(primitive.label() + " stands for void", "name a material");
    modifier = modifiers_[*original];
    modifier.warned = false;
    if (primitive.modifier != "inherit") modifier.before = find(primitive.modifier, primitive);
  } else {
    modifier.before = find(primitive.modifier, primitive);
    if (primitive.kind == RadianceKind::material) modifier.material = radiance_material(primitive);
    if (primitive.type == "illum" && !primitive.words.empty())
      modifier.alternate = find(primitive.words[0], primitive);
  }
  modifier.name = primitive.name;
  by_name_[primitive.name] = modifiers_.size();
  modifiers_.push_back(std::move(modifier));
}

RadianceModifiers::Link RadianceModifiers::end_of(Link link, bool& patterned) const {
  while (link && !modifiers_[*link].material) {
    patterned = true;
    link = modifiers_[*link].before;
  }
  return link;
}

RadianceMaterial RadianceModifiers::material_of(const RadiancePrimitive& shape,
                                                Warnings& warnings) {
  bool patterned = false;
  const Link end = end_of(find(shape.modifier, shape), patterned);
  RadianceMaterial result;
  if (!end) {
    result.passes_light = true;
    warnings.add(in_quotes(shape.name), "no material (void): left out, light passes");
    return result;
  }
  Modifier& modifier = modifiers_[*end];
  result = *modifier.material;
  end_of(modifier.before, patterned);
  if (modifier.alternate) {
    if (const Link alternate = end_of(modifier.alternate, patterned))
      result.reflectance = modifiers_[*alternate].material->reflectance;
  }
  if (!modifier.warned) {
    modifier.warned = true;
    const std::string where = in_quotes(modifier.name);
    for (const std::string& loss : result.losses) warnings.add(where, loss);
    if (patterned)
      warnings.add(where, "pattern or texture left out: the color of the material alone is taken");
  }
  return result;
}

}  // namespace enfilade
