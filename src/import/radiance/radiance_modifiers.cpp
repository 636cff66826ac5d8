#include "import/radiance/radiance_modifiers.hpp"

#include <algorithm>
#include <numbers>

#include "base/error.hpp"
#include "import/radiance/radiance_distribution.hpp"
#include "json/json_text.hpp"

namespace enfilade {

RadianceModifiers::Link RadianceModifiers::find(const std::string& name,
                                                const RadiancePrimitive& user) const {
  if (name == "void") return {};
  const auto it = by_name_.find(name);
  if (it == by_name_.end()) {
    user.place.fail(
        user.label() + " names " + radiance_quoted(name) + ", which is not defined",
        "define it before its use; where materials have a file of their own, give both: "
        "materials.rad room.rad");
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
    if (primitive.kind == RadianceKind::material) {
      modifier.material = primitive.type.compare(0, 3, "mix") == 0 ? mixture(primitive)
                                                                   : radiance_material(primitive);
    } else {
      if (auto found = radiance_distribution(primitive, files_))
        modifier.distribution = std::make_shared<const RadianceDistribution>(std::move(*found));
    }
    if (primitive.type == "illum" && !primitive.words.empty())
      modifier.alternate = find(primitive.words[0], primitive);
  }
  modifier.name = primitive.name;
  by_name_[primitive.name] = modifiers_.size();
  modifiers_.push_back(std::move(modifier));
}

RadianceModifiers::Link RadianceModifiers::end_of(Link link, Patterns& patterns) const {
  while (link && !modifiers_[*link].material) {
    const auto& distribution = modifiers_[*link].distribution;
    if (distribution && !patterns.distribution)
      patterns.distribution = distribution;
    else
      patterns.any_left_out = true;
    link = modifiers_[*link].before;
  }
  return link;
}

RadianceMaterial RadianceModifiers::mixture(const RadiancePrimitive& primitive) const {
  if (primitive.words.size() < 3) {
    primitive.place.fail(
        primitive.label() + " has " + std::to_string(primitive.words.size()) + " words",
        "write its foreground, its background and their share");
  }
  RadianceMaterial result;
  double share = 0.5;  // of the foreground, where a function or a picture says it
  try {
    share = std::clamp(radiance_number(primitive.words[2], primitive.place), 0.0, 1.0);
  } catch (const InputError&) {
    result.losses.push_back(primitive.type + ": taken as half of each");
  }
  double open_share = 0.0;
  for (const auto& [name, weight] :
       {std::pair{primitive.words[0], share}, {primitive.words[1], 1.0 - share}}) {
    Patterns ignored;
    const Link end = end_of(find(name, primitive), ignored);
    const RadianceMaterial part = end ? *modifiers_[*end].material : RadianceMaterial{};
    const bool is_clear = !part.transmittance.empty() && part.transmittance[0] > 0.5;
    if (!end || part.passes_light || is_clear) {
      open_share += weight;
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      result.reflectance[i] += weight * part.reflectance[i];
      result.exitance[i] += weight * part.exitance[i];
    }
  }
  result.passes_light = open_share > 0.5;
  if (open_share > 0.0) {
    result.losses.push_back(primitive.type + (result.passes_light
                                                  ? ": more than half open: left out, light passes"
                                                  : ": half open or less: taken as opaque"));
  }
  return result;
}

RadianceMaterial RadianceModifiers::material_of(const RadiancePrimitive& shape,
                                                Warnings& warnings) {
  Patterns patterns;
  const Link end = end_of(find(shape.modifier, shape), patterns);
  RadianceMaterial result;
  if (!end) {
    result.passes_light = true;
    warnings.add(in_quotes(shape.name), "no material (void): left out, light passes");
    return result;
  }
  Modifier& modifier = modifiers_[*end];
  result = *modifier.material;
  end_of(modifier.before, patterns);
  if (modifier.alternate) {
    if (const Link alternate = end_of(modifier.alternate, patterns))
      result.reflectance = modifiers_[*alternate].material->reflectance;
  }
  const bool distributed = result.emits() && patterns.distribution;
  if (distributed) {
    // Its material's exitance is pi times the radiance that the distribution multiplies.
    for (double& band : result.exitance) band *= patterns.distribution->exitance / std::numbers::pi;
    if (patterns.distribution->data) result.distribution = patterns.distribution;
  }
  if (!modifier.warned) {
    modifier.warned = true;
    const std::string where = in_quotes(modifier.name);
    for (const std::string& loss : result.losses) warnings.add(where, loss);
    if (distributed && !result.distribution)
      warnings.add(where,
                   "distribution of light: its flux is kept, and leaves as from a dull surface");
    if (patterns.any_left_out || (patterns.distribution && !distributed))
      warnings.add(where, "pattern or texture left out: the color of the material alone is taken");
  }
  return result;
}

}  // namespace enfilade
