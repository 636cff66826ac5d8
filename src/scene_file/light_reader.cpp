#include "scene_file/light_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "base/limits.hpp"
#include "json/json_text.hpp"
#include "scene/photopic.hpp"

namespace enfilade {
namespace {

using nlohmann::json;

using std::numbers::pi;
const char* const efficacy_note =
    "scene in W/m2: lumens of luminaires count as watts by 179 lm/W, alike in all bands";

}  // namespace

void LightReader::note_unknown(const json& entry, const char* list,
                               std::initializer_list<std::string_view> known) {
  for (auto it = entry.begin(); it != entry.end(); ++it) {
    if (std::find(known.begin(), known.end(), it.key()) == known.end())
      unknown_.insert(list + ("[]." + it.key()));
  }
}

Spectrum LightReader::light_of(const json& entry, const char* key, const std::string& where) {
  Spectrum light = keys_.spectrum(keys_.need(entry, key, where), where + "." + key,
                                  std::numeric_limits<double>::infinity());
  note_bands_(light, where + "." + key);
  return light;
}

void LightReader::read_lights(const json& document, Scene& scene) {
  const auto it = document.find("lights");
  if (it == document.end()) return;
  for (std::size_t i = 0; i < keys_.list(*it, "lights").size(); ++i)
    scene.lights.push_back(read_light((*it)[i], "lights[" + std::to_string(i) + "]"));
}

LightSource LightReader::read_light(const json& entry, const std::string& where) {
  const json& type = keys_.need(entry, "type", where);
  const bool spot = type == "spot";
  if (!spot && type != "point") {
    keys_.fail(where + ".type", "is " + shown(type) + ", not a known kind",
               "write \"point\" or \"spot\", or put a luminaire among \"luminaires\"");
  }
  if (entry.contains("distribution") && entry["distribution"] != "isotropic") {
    keys_.fail(where + ".distribution", "is " + shown(entry["distribution"]),
               "write \"isotropic\", or put the light among \"luminaires\"");
  }
  LightSource light;
  light.p = keys_.place(keys_.need(entry, "p", where), where + ".p", scale_);
  if (entry.contains("name")) light.name = keys_.text(entry["name"], where + ".name");
  if (entry.contains("switch")) light.switch_name = keys_.text(entry["switch"], where + ".switch");
  const std::string name = light.name, switch_name = light.switch_name;
  const bool by_flux = !entry.contains("intensity") && entry.contains("flux");
  Spectrum given = light_of(entry, by_flux ? "flux" : "intensity", where);
  if (!spot) {
    note_unknown(entry, "lights",
                 {"type", "p", "intensity", "flux", "name", "switch", "distribution"});
    for (double& band : given) band /= by_flux ? 4.0 * pi : 1.0;
    light.intensity = std::move(given);
    return light;
  }
  note_unknown(entry, "lights",
               {"type", "p", "intensity", "flux", "name", "switch", "distribution", "direction",
                "innerConeAngle", "outerConeAngle"});
  const auto angle = [&](const char* key, double otherwise) {
    return entry.contains(key) ? keys_.finite(entry[key], where + "." + key) : otherwise;
  };
  const SpotCone cone{angle("innerConeAngle", 0.0), angle("outerConeAngle", 0.25 * pi)};
  if (!(cone.inner >= 0.0 && cone.inner <= cone.outer && cone.outer > 1e-4 && cone.outer <= pi)) {
    keys_.fail(where, "has cone angles that do not grow from 0 to pi",
               "write half angles in radians, innerConeAngle up to outerConeAngle");
  }
  const Vec3 direction =
      keys_.direction(keys_.need(entry, "direction", where), where + ".direction");
  light = spot_light(light.p, direction, given, cone);
  light.name = name;
  light.switch_name = switch_name;
  if (by_flux) {
    for (std::size_t b = 0; b < given.size(); ++b) light.intensity[b] = given[b] / (4.0 * pi);
  }
  return light;
}

LightFrame LightReader::frame_of(const json& entry, const std::string& where) {
  const Vec3 aim =
      entry.contains("aim") ? keys_.direction(entry["aim"], where + ".aim") : Vec3(0.0, 0.0, -1.0);
  if (!entry.contains("up")) return LightFrame::of(aim);
  const auto frame = LightFrame::of(aim, keys_.direction(entry["up"], where + ".up"));
  if (!frame)
    keys_.fail(where + ".up", "is parallel to the aim", "write another direction than the aim's");
  return *frame;
}

/// 0, or extents along the luminaire's x and y axes, or these and along its aim.
LuminousOpening LightReader::opening_of(const json& size, const std::string& where) {
  if (size == 0) return {};
  if (!size.is_array() || (size.size() != 2 && size.size() != 3))
    keys_.fail(where, "is " + shown(size), "write [x, y] or [x, y, z], or 0 for a point");
  LuminousOpening opening;
  for (std::size_t i = 0; i < size.size(); ++i) {
    const double x = keys_.finite(size[i], where + "[" + std::to_string(i) + "]");
    opening.size[static_cast<int>(i)] = scale_ * x;
  }
  if (const auto fault = limits::fault_of_opening(opening.size))
    keys_.fail(where, fault.what, fault.hint);
  if (std::max({opening.size.x, opening.size.y, opening.size.z}) <= 0.0) return {};
  opening.shape = opening.size.z > 0.0 ? OpeningShape::box : OpeningShape::rectangle;
  return opening;
}

void LightReader::read_luminaires(json& document, Scene& scene) {
  const auto it = document.find("luminaires");
  if (it == document.end()) return;
  keys_.list(*it, "luminaires");
  for (std::size_t i = 0; i < it->size(); ++i) {
    const std::string where = "luminaires[" + std::to_string(i) + "]";
    json& entry = document["luminaires"][i];
    if (!entry.is_object())
      keys_.fail(where, "is " + shown(entry), "write {\"p\": [x, y, z], ...}");
    if (entry.contains("file") || entry.contains("distribution") || entry.contains("flux"))
      read_luminaire(entry, where, scene);
  }
}

void LightReader::read_luminaire(json& entry, const std::string& where, Scene& scene) {
  note_unknown(entry, "luminaires",
               {"file", "distribution", "p", "aim", "up", "size", "flux", "name", "switch", "type",
                "flux_lm"});
  LightSource light;
  light.p = keys_.place(keys_.need(entry, "p", where), where + ".p", scale_);
  light.frame = frame_of(entry, where);
  if (entry.contains("name")) light.name = keys_.text(entry["name"], where + ".name");
  if (entry.contains("switch")) light.switch_name = keys_.text(entry["switch"], where + ".switch");
  Spectrum flux;
  if (entry.contains("flux")) flux = light_of(entry, "flux", where);
  if (const DistributionSource::Found* found = distributions_.find(entry, where)) {
    light.distribution = found->light.distribution;
    light.shape = found->light.opening;
    if (flux.empty()) {
      const double tilt = std::acos(std::clamp(-light.frame.aim.z, -1.0, 1.0)) * 180.0 / pi;
      flux = {light.distribution->flux() * found->tilt.factor(tilt)};
      // A copy of the scene has the table alone, without the lamps' tilt.
      if (!found->tilt.degrees.empty()) entry["flux"] = flux[0];
    }
  }
  if (entry.contains("size")) light.shape = opening_of(entry["size"], where + ".size");
  const double factor = per_lumen(scene.unit) / (4.0 * pi);
  for (const double lumens : flux) light.intensity.push_back(factor * lumens);
  if (scene.unit == ExitanceUnit::watt_per_m2) warnings_.add(where, efficacy_note);
  scene.lights.push_back(std::move(light));
}

void LightReader::read_distribution(json& entry, const std::string& where, ExitanceUnit unit,
                                    Surface& surface) {
  const DistributionSource::Found* found = distributions_.find(entry, where);
  if (found == nullptr) return;
  const std::string key = where + ".distribution";
  if (surface.two_sided) {
    keys_.fail(key, "is of a two-sided surface, whose sides would shine alike",
               "write two surfaces, back to back");
  }
  if (entry.contains("up")) surface.up = keys_.direction(entry["up"], where + ".up");
  const double whole = found->light.distribution->flux();
  try {
    auto front =
        std::make_shared<const IntensityDistribution>(found->light.distribution->front_half());
    constexpr double little = 1e-3;
    if (front->flux() < (1.0 - little) * whole) {
      warnings_.add(where,
                    "distribution that also shines backwards: that part is left out, the "
                    "exitance stays");
    }
    surface.distribution = std::move(front);
  } catch (const std::invalid_argument& fault) {
    keys_.fail(key, fault.what(), "give one that shines along the surface's normal");
  }
  if (entry.contains("exitance")) return;
  const double area = area_m2(surface.vertices);
  if (unit == ExitanceUnit::watt_per_m2) warnings_.add(where, efficacy_note);
  if (area > 0.0) surface.exitance = {surface.distribution->flux() * per_lumen(unit) / area};
}

}  // namespace enfilade
