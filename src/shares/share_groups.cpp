#include "shares/share_groups.hpp"

#include <algorithm>
#include <map>

#include "base/error.hpp"

namespace enfilade {
namespace {

bool shines(const Spectrum& light) {
  return std::ranges::any_of(light, [](double band) { return band > 0.0; });
}

std::string first_of(const std::string& a, const std::string& b, const std::string& otherwise) {
  return !a.empty() ? a : !b.empty() ? b : otherwise;
}

}  // namespace

std::vector<ShareGroup> share_groups(const Scene& scene) {
  std::vector<ShareGroup> groups;
  std::map<std::string, std::size_t> number_of;
  const auto group_of = [&](const std::string& name) -> ShareGroup& {
    const auto [at, added] = number_of.emplace(name, groups.size());
    if (added) groups.push_back({name, {}, {}});
    return groups[at->second];
  };
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const LightSource& light = scene.lights[i];
    if (!shines(light.intensity)) continue;
    group_of(first_of(light.switch_name, light.name, "light " + std::to_string(i)))
        .lights.push_back(i);
  }
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& surface = scene.surfaces[i];
    if (!shines(surface.exitance)) continue;
    const std::string name = first_of(surface.object, surface.name, "surface " + std::to_string(i));
    group_of(surface.switch_name.empty() ? name : surface.switch_name).surfaces.emplace_back(i);
  }
  if (groups.empty()) {
    throw InputError(scene.file, "shares", "nothing in the scene emits light",
                     "give surfaces an exitance, or the scene lights");
  }
  return groups;
}

std::size_t find_group(const std::vector<std::string>& names, const std::string& name,
                       const std::string& option) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  constexpr std::size_t most_names = 20;
  std::string known;
  for (std::size_t i = 0; i < std::min(names.size(), most_names); ++i)
    known += (i > 0 ? ", " : "") + names[i];
  if (names.size() > most_names) known += ", ...";
  throw InputError("command line", option, "no light or switch has the name '" + name + "'",
                   "name one of " + known);
}

}  // namespace enfilade
