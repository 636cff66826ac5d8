#include "light_survey/light_survey.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/sampling.hpp"
#include "json/json_text.hpp"
#include "raycast/ray_scene.hpp"
#include "scene/convex_parts.hpp"

namespace enfilade {
namespace {

double strongest(const Spectrum& bands) {
  return bands.empty() ? 0.0 : *std::max_element(bands.begin(), bands.end());
}

std::string percent(double share) { return std::to_string(std::lround(100.0 * share)) + " %"; }

std::string label_of(const Surface& surface, std::size_t index) {
  return surface.name.empty() ? "surfaces[" + std::to_string(index) + "]" : in_quotes(surface.name);
}

/// Something that gives light: a convex part of one side of a surface, or a light.
struct Emitter {
  double power = 0.0;
  std::uint32_t polygon = RayScene::no_polygon;  ///< none for a light
  bool back = false;                             ///< of a surface that emits from both sides
  const LightSource* light = nullptr;
};

/// What became of a lamp's light; lamps are objects where surfaces name them.
struct LampLight {
  double power = 0.0, power_close = 0.0;
  std::size_t surface = 0;  ///< one of the lamp's
};

class Survey {
 public:
  Survey(const Scene& scene, Warnings& warnings) : scene_(scene), warnings_(warnings) {
    const SceneScale scale(scene);
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
      for (Polygon& part : convex_parts(scene.surfaces[s].vertices, scale).parts) {
        polygons_.push_back(std::move(part));
        surface_of_.push_back(s);
        panes_.push_back(scene.surfaces[s].is_pane() ? 1 : 0);
      }
    }
    back_power_.resize(scene.surfaces.size());
    collect_emitters();
  }

  void tell() {
    constexpr std::size_t rays = 16384, fewest = 16;
    const RayScene blockers(polygons_, panes_);
    Random random(1);
    double total = 0.0;
    for (const Emitter& e : emitters_) total += e.power;
    for (const Emitter& e : emitters_) {
      const auto share = static_cast<std::size_t>(static_cast<double>(rays) * e.power / total);
      follow(e, std::max(fewest, share), blockers, random);
    }
    tell_of_backs(total);
    tell_of_close_lamps();
  }

 private:
  void collect_emitters() {
    for (std::uint32_t i = 0; i < polygons_.size(); ++i) {
      const Surface& surface = scene_.surfaces[surface_of_[i]];
      const double power = strongest(surface.exitance) * area_m2(polygons_[i]);
      if (power <= 0.0) continue;
      emitters_.push_back({power, i, false, nullptr});
      if (surface.two_sided) emitters_.push_back({power, i, true, nullptr});
    }
    for (const LightSource& light : scene_.lights) {
      const double power = power_per_intensity(light) * strongest(light.intensity);
      if (power > 0.0 && !light.is_far())
        emitters_.push_back({power, RayScene::no_polygon, false, &light});
    }
    // The brightest thousand tell enough, and cost no time.
    constexpr std::size_t most = 1024;
    if (emitters_.size() <= most) return;
    std::stable_sort(emitters_.begin(), emitters_.end(),
                     [](const Emitter& a, const Emitter& b) { return a.power > b.power; });
    emitters_.resize(most);
  }

  LampLight& lamp_of(std::uint32_t surface) {
    const std::string& object = scene_.surfaces[surface].object;
    return lamps_
        .try_emplace(object.empty() ? "#" + std::to_string(surface) : object,
                     LampLight{0.0, 0.0, surface})
        .first->second;
  }

  void follow(const Emitter& emitter, std::size_t rays, const RayScene& blockers, Random& random) {
    const bool point = emitter.light != nullptr;
    const Polygon* polygon = point ? nullptr : &polygons_[emitter.polygon];
    const Vec3 n = point ? Vec3(0.0) : (emitter.back ? -1.0 : 1.0) * normal(*polygon);
    const double close = point ? 0.0 : 0.1 * std::sqrt(area_m2(*polygon));
    const double of_ray = emitter.power / static_cast<double>(rays);
    for (std::size_t i = 0; i < rays; ++i) {
      // The first number of each direction is stratified.
      const double along = (static_cast<double>(i) + random.uniform()) / static_cast<double>(rays);
      const double turn = random.uniform();
      LightRay ray;
      if (point && emitter.light->opening.empty()) {
        ray = emitted_ray(*emitter.light, along, turn, 0.0, 0.0);
      } else {
        const double r1 = random.uniform(), r2 = random.uniform();
        ray = point ? emitted_ray(*emitter.light, along, turn, r1, r2)
                    : LightRay{uniform_point(*polygon, r1, r2), cosine_direction(n, along, turn)};
      }
      const double power = of_ray * ray.weight;
      const RayHit hit = blockers.closest(ray.from, ray.direction, emitter.polygon, 1e30,
                                          point ? RayStart::in_air : RayStart::on_polygon);
      if (!point) {
        LampLight& lamp = lamp_of(surface_of_[emitter.polygon]);
        lamp.power += power;
        if (hit.any() && hit.distance_m < close) lamp.power_close += power;
      }
      if (!hit.any() || hit.front) continue;
      const std::uint32_t surface = surface_of_[hit.polygon];
      if (!scene_.surfaces[surface].two_sided) back_power_[surface] += power;
    }
  }

  void tell_of_backs(double total) {
    double backs = 0.0;
    for (const double power : back_power_) backs += power;
    if (backs <= 0.5 * total) return;
    std::vector<std::size_t> order(back_power_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return back_power_[a] > back_power_[b]; });
    const std::string what = "faces away from the lamps: " + percent(backs / total) +
                             " of their light falls on black backs, as if rooms were inside out; "
                             "turn such surfaces around, or make them two-sided";
    for (const std::size_t s : order) {
      if (back_power_[s] > 1e-3 * total) warnings_.add(label_of(scene_.surfaces[s], s), what);
    }
  }

  void tell_of_close_lamps() {
    for (const auto& [name, lamp] : lamps_) {
      if (lamp.power_close <= 0.8 * lamp.power) continue;
      warnings_.add(
          label_of(scene_.surfaces[lamp.surface], lamp.surface),
          "lamp that lights little but what stands close before it: it may face the wrong "
          "way; turn it around");
    }
  }

  const Scene& scene_;
  Warnings& warnings_;
  std::vector<Polygon> polygons_;
  std::vector<std::uint32_t> surface_of_;
  std::vector<char> panes_;  ///< by polygon: light passes it
  std::vector<Emitter> emitters_;
  std::vector<double> back_power_;  ///< by surface
  std::map<std::string, LampLight> lamps_;
};

}  // namespace

LightSources light_sources(const Scene& scene) {
  LightSources sources;
  sources.power.assign(static_cast<std::size_t>(scene.bands), 0.0);
  for (const Surface& surface : scene.surfaces) {
    if (strongest(surface.exitance) <= 0.0) continue;
    ++sources.surfaces;
    const double area = area_m2(surface.vertices) * (surface.two_sided ? 2.0 : 1.0);
    for (std::size_t band = 0; band < sources.power.size(); ++band)
      sources.power[band] += area * surface.exitance[band];
  }
  for (const LightSource& light : scene.lights) {
    for (std::size_t band = 0; band < sources.power.size(); ++band)
      sources.power[band] += sent_per_intensity(light) * light.intensity[band];
  }
  return sources;
}

void survey_light(const Scene& scene, Warnings& warnings) {
  if (strongest(light_sources(scene).power) <= 0.0) {
    warnings.add("scene",
                 "has no light: all of it stays dark; give some surfaces an \"exitance\", "
                 "or the scene \"lights\"");
    return;
  }
  Survey(scene, warnings).tell();
}

void survey_far_lights(Scene& scene) {
  const auto is_far = [](const LightSource& light) { return light.is_far(); };
  if (std::ranges::none_of(scene.lights, is_far)) return;
  const SceneScale scale(scene);
  std::vector<Polygon> polygons;
  std::vector<char> panes, two_sided;
  for (const Surface& surface : scene.surfaces) {
    for (Polygon& part : convex_parts(surface.vertices, scale).parts) {
      polygons.push_back(std::move(part));
      panes.push_back(surface.is_pane() ? 1 : 0);
      two_sided.push_back(surface.two_sided ? 1 : 0);
    }
  }
  const RayScene blockers(polygons, panes);
  constexpr int rays = 1 << 17;
  for (LightSource& light : scene.lights) {
    if (!light.is_far()) continue;
    Random random(1);
    int met = 0;
    for (int i = 0; i < rays; ++i) {
      const double r1 = (i + random.uniform()) / rays, r2 = random.uniform();
      const double r3 = random.uniform(), r4 = random.uniform();
      const LightRay ray = emitted_ray(light, r1, r2, r3, r4);
      const RayHit hit =
          blockers.closest(ray.from, ray.direction, RayScene::no_polygon, 1e30, RayStart::in_air);
      met += hit.any() && (hit.front || two_sided[hit.polygon] != 0) ? 1 : 0;
    }
    light.arriving = std::max(1, met) / static_cast<double>(rays);
  }
}

}  // namespace enfilade
