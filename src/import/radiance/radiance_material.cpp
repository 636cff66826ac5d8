#include "import/radiance/radiance_material.hpp"

#include <cmath>
#include <map>
#include <numbers>

namespace enfilade {
namespace {

/// Where a type has its arguments; the color is always in front.
struct Layout {
  std::size_t least;             ///< numbers
  std::size_t specular;          ///< number of the specular share
  std::size_t transmission = 0;  ///< number of the share that passes; 0 for none
};

const std::map<std::string, Layout>& diffuse_types() {
  static const std::map<std::string, Layout> types{
      {"plastic", {5, 3}},      {"metal", {5, 3}},   {"trans", {7, 3, 5}},
      {"plastic2", {6, 3}},     {"metal2", {6, 3}},  {"trans2", {8, 3, 6}},
      {"plasfunc", {4, 3}},     {"metfunc", {4, 3}}, {"plasdata", {4, 3}},
      {"transfunc", {6, 3, 4}}, {"metdata", {4, 3}}, {"transdata", {6, 3, 4}}};
  return types;
}

double share(const RadiancePrimitive& material, std::size_t i) {
  const double value = material.numbers[i];
  if (value < 0.0 || value > 1.0) {
    material.place.fail(material.label() + ": number " + std::to_string(i + 1) + " is outside 0..1",
                        "write the share of the light that it stands for");
  }
  return value;
}

Spectrum color(const RadiancePrimitive& material) {
  Spectrum bands(material.numbers.begin(), material.numbers.begin() + 3);
  for (const double band : bands) {
    if (band < 0.0)
      material.place.fail(material.label() + " has a color below zero", "write 0 or more");
  }
  return bands;
}

RadianceMaterial reflecting(const RadiancePrimitive& material, const Layout& layout) {
  // A scene's reflectance lies below 1; Radiance takes 1 and more.
  constexpr double highest_reflectance = 0.999;
  RadianceMaterial result;
  const double specular = share(material, layout.specular);
  const double passing = layout.transmission > 0 ? share(material, layout.transmission) : 0.0;
  result.reflectance = color(material);
  bool clamped = false;
  for (double& band : result.reflectance) {
    band *= (1.0 - specular) * (1.0 - passing);
    clamped |= band > highest_reflectance;
    band = std::min(band, highest_reflectance);
  }
  if (clamped) result.losses.push_back("reflectance of 1 or more: taken as 0.999");
  if (specular > 0.0) result.losses.push_back("specular reflection left out");
  if (passing > 0.0) result.losses.push_back("transmission left out: lets no light through");
  return result;
}

RadianceMaterial emitting(const RadiancePrimitive& material) {
  RadianceMaterial result;
  double factor = std::numbers::pi;
  if (material.type == "spotlight") {
    // The same radiance within a cone of this full angle only: pi L sin^2 of the half.
    const double angle = std::clamp(material.numbers[3], 0.0, 180.0);
    factor *= std::pow(std::sin(0.5 * angle * std::numbers::pi / 180.0), 2.0);
    const Vec3 direction(material.numbers[4], material.numbers[5], material.numbers[6]);
    const double length = glm::length(direction);
    if (angle > 0.01 && length > 0.0 && std::isfinite(length)) {
      result.distribution = std::make_shared<const RadianceDistribution>(
          radiance_spot(direction, 0.5 * angle * std::numbers::pi / 180.0));
    } else {
      result.losses.push_back("beam left out: its light goes to all sides");
    }
  }
  result.exitance = color(material);
  for (double& band : result.exitance) {
    band *= factor;
    if (!std::isfinite(band))
      material.place.fail(material.label() + " is too bright", "write its radiance in W/(sr m2)");
  }
  return result;
}

/// Light that passes a pane is reflected at both faces and absorbed between them (Radiance's
/// manual: transmissivity is what is left of it from one face to the other).
double transmittance_of(double transmissivity) {
  constexpr double face = (1.52 - 1.0) * (1.52 - 1.0) / ((1.52 + 1.0) * (1.52 + 1.0));
  return (1.0 - face) * (1.0 - face) * transmissivity /
         (1.0 - face * face * transmissivity * transmissivity);
}

RadianceMaterial glass(const RadiancePrimitive& material) {
  if (material.numbers.size() < 3)
    material.place.fail(material.label() + " has fewer than 3 numbers", "write its transmissivity");
  RadianceMaterial result;
  for (const double band : color(material))
    result.transmittance.push_back(transmittance_of(std::min(band, 1.0)));
  return result;
}

bool any(const Spectrum& spectrum) {
  return std::any_of(spectrum.begin(), spectrum.end(), [](double band) { return band > 0.0; });
}

}  // namespace

bool RadianceMaterial::reflects() const { return any(reflectance); }
bool RadianceMaterial::emits() const { return any(exitance); }

RadianceMaterial radiance_material(const RadiancePrimitive& material) {
  static const std::map<std::string, std::size_t> emitters{
      {"light", 3}, {"illum", 3}, {"glow", 4}, {"spotlight", 7}};
  const auto need = [&](std::size_t least) {
    if (material.numbers.size() >= least) return;
    material.place.fail(material.label() + " has " + std::to_string(material.numbers.size()) +
                            " numbers, not " + std::to_string(least),
                        "complete it as the Radiance manual has it");
  };
  if (const auto it = diffuse_types().find(material.type); it != diffuse_types().end()) {
    need(it->second.least);
    return reflecting(material, it->second);
  }
  if (const auto it = emitters.find(material.type); it != emitters.end()) {
    need(it->second);
    return emitting(material);
  }
  if (material.type == "glass") return glass(material);
  RadianceMaterial result;
  const bool clear = material.type == "dielectric" || material.type == "interface";
  result.passes_light = clear || material.type == "antimatter" || material.type == "mist";
  result.losses.push_back(result.passes_light
                              ? material.type + ": its surfaces are left out, light passes"
                              : material.type + ": taken as black and opaque (reflectance 0)");
  return result;
}

}  // namespace enfilade
