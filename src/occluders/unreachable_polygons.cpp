#include "occluders/unreachable_polygons.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

double most(const Spectrum& bands) {
  return bands.empty() ? 0.0 : *std::max_element(bands.begin(), bands.end());
}

class RoughLight {
 public:
  RoughLight(const Scene& scene, std::span<const Cluster> clusters, const Occluders& occluders,
             WorkCount& work)
      : lights_(scene.lights), occluders_(occluders), work_(work) {
    for (const Cluster& c : clusters) {
      for (const ClusterPolygon& p : c.polygons) {
        const Surface& surface = scene.surfaces[p.surface.index()];
        places_.push_back({&p.polygon, normal(p.polygon), centroid(p.polygon), area_m2(p.polygon),
                           most(surface.reflectance), most(surface.exitance)});
      }
    }
    direct_.assign(places_.size(), 0.0);
    sees_.resize(places_.size());
    rays_.assign(places_.size(), 0);
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(places_.size()); }
  void shine(int rays);
  void look(std::uint32_t polygon, int rays);
  void spread();
  bool dim(std::uint32_t polygon, double share) const {
    return places_[polygon].exitance <= 0.0 && irradiance_[polygon] <= share * mean_;
  }
  bool sees_a_lamp(std::uint32_t polygon) const;

 private:
  struct Place {
    const Polygon* polygon;
    Vec3 n, middle;
    double area_m2, reflectance, exitance;
  };
  RayHit cast(std::uint32_t polygon, double r2, Random& random) const;

  std::span<const PointLight> lights_;
  const Occluders& occluders_;
  WorkCount& work_;
  std::vector<Place> places_;
  std::vector<double> direct_, irradiance_;
  std::vector<std::vector<std::uint32_t>> sees_;  ///< front sides that the polygon's rays end on
  std::vector<int> rays_;
  double mean_ = 0.0;
};

/// A ray from anywhere on the polygon, its direction by the cosine.
RayHit RoughLight::cast(std::uint32_t polygon, double r2, Random& random) const {
  const Place& place = places_[polygon];
  // A ray that starts on the rim would slip behind a polygon that meets it there.
  const double inside = 1.0 - std::clamp(8.0 * occluders_.rays().epsilon_m() /
                                             std::sqrt(std::max(place.area_m2, 1e-30)),
                                         1e-3, 0.5);
  const Vec3 any = random_point(*place.polygon, random);
  ++work_.rays;
  return occluders_.rays().closest(place.middle + inside * (any - place.middle),
                                   cosine_direction(place.n, r2, random.uniform()), polygon);
}

/// Light of the lamps, carried along rays from them.
void RoughLight::shine(int rays) {
  const auto arrive = [this](const RayHit& hit, double power) {
    if (hit.any() && hit.front) direct_[hit.polygon] += power / places_[hit.polygon].area_m2;
  };
  for (std::uint32_t k = 0; k < size(); ++k) {
    if (places_[k].exitance <= 0.0) continue;
    Random random(std::uint64_t{k} << 32);
    const double power = places_[k].area_m2 * places_[k].exitance / rays;
    for (int i = 0; i < rays; ++i) arrive(cast(k, (i + random.uniform()) / rays, random), power);
  }
  for (const PointLight& light : lights_) {
    Random random(size());
    const double power = 4.0 * std::numbers::pi * most(light.intensity) / rays;
    for (int i = 0; i < rays; ++i) {
      const double z = 2.0 * (i + random.uniform()) / rays - 1.0;
      ++work_.rays;
      arrive(occluders_.rays().closest(light.p, sphere_direction(z, random.uniform())), power);
    }
  }
}

void RoughLight::look(std::uint32_t polygon, int rays) {
  Random random((std::uint64_t{polygon} << 32) + static_cast<std::uint64_t>(rays));
  for (int i = 0; i < rays; ++i) {
    const RayHit hit = cast(polygon, (i + random.uniform()) / rays, random);
    if (hit.any() && hit.front) sees_[polygon].push_back(hit.polygon);
  }
  rays_[polygon] += rays;
}

/// Gauss-Seidel, one way and the other, until light has been everywhere.
void RoughLight::spread() {
  irradiance_ = direct_;
  for (int sweep = 0; sweep < 64; ++sweep) {
    double power = 0.0, area = 0.0, change = 0.0;
    for (std::uint32_t i = 0; i < size(); ++i) {
      const std::uint32_t k = sweep % 2 == 0 ? i : size() - 1 - i;
      double sum = 0.0;
      for (const std::uint32_t other : sees_[k])
        sum += places_[other].reflectance * irradiance_[other];
      const double e = direct_[k] + (rays_[k] > 0 ? sum / rays_[k] : 0.0);
      change += places_[k].area_m2 * std::abs(e - irradiance_[k]);
      irradiance_[k] = e;
      power += places_[k].area_m2 * e;
      area += places_[k].area_m2;
    }
    mean_ = area > 0.0 ? power / area : 0.0;
    if (change <= 1e-3 * power) break;
  }
}

bool RoughLight::sees_a_lamp(std::uint32_t polygon) const {
  const Place& place = places_[polygon];
  const auto open = [&](const Vec3& y, std::uint32_t lamp) {
    ++work_.rays;
    return !occluders_.rays().occluded(place.middle, y, polygon, lamp);
  };
  for (const PointLight& light : lights_) {
    if (glm::dot(place.n, light.p - place.middle) > 0.0 && open(light.p, RayScene::no_polygon))
      return true;
  }
  for (std::uint32_t k = 0; k < size(); ++k) {
    const Place& lamp = places_[k];
    if (k == polygon || lamp.exitance <= 0.0) continue;
    const Vec3 d = lamp.middle - place.middle;
    if (glm::dot(place.n, d) > 0.0 && glm::dot(lamp.n, d) < 0.0 && open(lamp.middle, k))
      return true;
  }
  return false;
}

}  // namespace

std::vector<char> unreachable_polygons(const Scene& scene, std::span<const Cluster> clusters,
                                       const Occluders& occluders, WorkCount& work,
                                       const DarkConfig& config) {
  RoughLight light(scene, clusters, occluders, work);
  const std::uint32_t n = light.size();
  std::vector<char> dark(n, 0);
  if (n == 0) return dark;
  light.shine(std::max(config.more_rays, config.least_rays / static_cast<int>(n)));
  const int rays = std::max(config.rays, config.least_rays / static_cast<int>(n));
  for (std::uint32_t k = 0; k < n; ++k) light.look(k, rays);
  light.spread();
  std::vector<std::uint32_t> dim;
  for (std::uint32_t k = 0; k < n; ++k) {
    if (light.dim(k, config.share)) dim.push_back(k);
  }
  if (dim.empty()) return dark;
  const int more = std::max(config.more_rays, config.least_rays / static_cast<int>(dim.size()));
  for (const std::uint32_t k : dim) light.look(k, more);
  light.spread();
  for (const std::uint32_t k : dim) {
    dark[k] = light.dim(k, config.share) && !light.sees_a_lamp(k) ? 1 : 0;
  }
  return dark;
}

}  // namespace enfilade
