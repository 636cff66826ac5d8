#include "solver/importance.hpp"

#include <algorithm>

#include "base/random.hpp"
#include "final_gather/point_place.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

constexpr int most_bounces = 64;

/// The polygons that walks may end on, by their global numbers.
struct Walls {
  std::vector<double> area_m2, reflectance;
  std::vector<Vec3> normals;
};

Walls walls_of(const Scene& scene, std::span<const Cluster> clusters) {
  Walls walls;
  for (const Cluster& cluster : clusters) {
    for (const ClusterPolygon& p : cluster.polygons) {
      const Spectrum& reflectance = scene.surfaces[p.surface.index()].reflectance;
      walls.area_m2.push_back(area_m2(p.polygon));
      walls.normals.push_back(normal(p.polygon));
      walls.reflectance.push_back(*std::max_element(reflectance.begin(), reflectance.end()));
    }
  }
  return walls;
}

/// A walk passes each pane by chance, by what the pane passes; false where one stops it.
bool passes_panes(const Vec3& from, const Vec3& direction, std::uint32_t own, const RayHit& hit,
                  const Walls& walls, const Occluders& occluders, Random& random,
                  std::vector<double>& hits) {
  const double length_m = hit.any() ? hit.distance_m : far_away_m;
  for (const PaneMet& pane :
       occluders.panes_along(from, direction, length_m, own, RayStart::in_air)) {
    if (pane.front && walls.reflectance[pane.polygon] > 0.0) hits[pane.polygon] += 1.0;
    if (random.uniform() * pane.before.share >= pane.behind.share) return false;
  }
  return true;
}

/// One walk: adds 1 for each polygon on whose front it arrives, until it is absorbed.
void walk(Vec3 from, Vec3 direction, std::uint32_t own, const Walls& walls,
          const Occluders& occluders, Random& random, WorkCount& work, std::vector<double>& hits) {
  for (int bounces = 0; bounces < most_bounces; ++bounces) {
    ++work.rays;
    const RayHit hit = occluders.rays().closest(from, direction, own, 1e30, RayStart::in_air);
    if (occluders.panes().any() &&
        !passes_panes(from, direction, own, hit, walls, occluders, random, hits))
      return;
    if (!hit.any() || !hit.front) return;
    hits[hit.polygon] += 1.0;
    if (random.uniform() >= walls.reflectance[hit.polygon]) return;
    own = hit.polygon;
    const Vec3& n = walls.normals[own];
    from += hit.distance_m * direction + 2.0 * occluders.rays().epsilon_m() * n;
    const double r2 = random.uniform(), turn = random.uniform();
    direction = cosine_direction(n, r2, turn);
  }
}

/// Importance per area of each polygon, from the hits of the walks on it and on its cluster.
std::vector<double> densities(std::span<const double> hits, const Walls& walls,
                              std::span<const Cluster> clusters, double prior_hits) {
  std::vector<double> density;
  density.reserve(hits.size());
  for (const Cluster& cluster : clusters) {
    const std::size_t first = density.size(), end = first + cluster.polygons.size();
    double area = 0.0, sum = 0.0;
    for (std::size_t k = first; k < end; ++k) {
      area += walls.area_m2[k];
      sum += hits[k];
    }
    const double mean = area > 0.0 ? sum / area : 0.0;
    for (std::size_t k = first; k < end; ++k) {
      const double expected = mean * walls.area_m2[k];
      const double posterior = mean * (hits[k] + prior_hits) / (expected + prior_hits);
      density.push_back(posterior * walls.reflectance[k]);
    }
  }
  return density;
}

bool is_blind(const Probe& point, const Scene& scene, const Occluders& occluders, Random& random) {
  constexpr int rays = 256;
  const Vec3 from = lifted(occluders, point.p, point.n);
  const std::uint32_t own = surface_at(occluders, point.p, point.n);
  int fronts = 0, backs = 0;
  for (int i = 0; i < rays; ++i) {
    const double r2 = (i + random.uniform()) / rays, turn = random.uniform();
    const RayHit hit = occluders.rays().closest(from, cosine_direction(point.n, r2, turn), own,
                                                1e30, RayStart::in_air);
    backs += hit.any() && !hit.front;
    fronts += hit.any() ? hit.front : scene.sky.has_value();
  }
  return fronts == 0 || 2 * backs > rays;
}

}  // namespace

std::size_t blind_points(std::span<const Probe> points, const Scene& scene,
                         const Occluders& occluders) {
  Random random(1);
  return static_cast<std::size_t>(std::ranges::count_if(
      points, [&](const Probe& point) { return is_blind(point, scene, occluders, random); }));
}

std::vector<float> importance_to(std::span<const Probe> points, const Scene& scene,
                                 std::span<const Cluster> clusters, const Occluders& occluders,
                                 WorkCount& work, const ImportanceConfig& config) {
  if (points.empty()) return {};
  const Walls walls = walls_of(scene, clusters);
  std::vector<double> hits(walls.area_m2.size(), 0.0);
  Random random(config.seed);
  const auto count = static_cast<int>(points.size());
  for (int i = 0; i < count; ++i) {
    const Probe& point = points[static_cast<std::size_t>(i)];
    const Vec3 from = lifted(occluders, point.p, point.n);
    const std::uint32_t own = surface_at(occluders, point.p, point.n);
    const int walks = std::max(1, config.walks / count);
    for (int k = 0; k < walks; ++k) {
      const double r2 = (k + random.uniform()) / walks, turn = random.uniform();
      walk(from, cosine_direction(point.n, r2, turn), own, walls, occluders, random, work, hits);
    }
  }
  const std::vector<double> density = densities(hits, walls, clusters, config.prior_hits);
  double sum = 0.0, area = 0.0;
  for (std::size_t k = 0; k < density.size(); ++k) {
    sum += density[k] * walls.area_m2[k];
    area += walls.area_m2[k];
  }
  std::vector<float> importance(density.size(), 1.0f);
  for (std::size_t k = 0; k < density.size() && sum > 0.0; ++k) {
    const double relative = density[k] * area / sum;
    importance[k] = static_cast<float>(config.everywhere + (1.0 - config.everywhere) * relative);
  }
  return importance;
}

}  // namespace enfilade
