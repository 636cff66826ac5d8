#include <algorithm>
#include <cmath>

#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"
#include "occluders/light_at.hpp"
#include "report/pictures/gathered_light.hpp"

namespace enfilade {
namespace {

/// Emitters that may give a smaller share of a place's direct light get one shadow ray.
constexpr double large_share = 0.05;
constexpr int shadow_rays = 6;

/// The mean radiosity per band of a polygon.
double mean_radiosity(const PatchForest& forest, std::uint32_t k, std::size_t band) {
  return forest.radiosity(k)[band * static_cast<std::size_t>(forest.terms())];
}

}  // namespace

QuickGather::QuickGather(const SolvedScene& solved, int rays)
    : solved_(solved), rays_(rays), sampler_(solved.states, solved.occluders) {
  for (const Cluster& cluster : solved.clusters) {
    for (std::uint32_t k = 0; k < cluster.polygons.size(); ++k) {
      const std::uint32_t polygon = solved.occluders.global(cluster.id, k);
      if (!sampler_.contains(polygon)) continue;
      emitters_.push_back(
          {polygon, cluster.polygons[k].polygon, &solved.states[cluster.id.index()].patches(), k});
    }
  }
}

/// By one ray to each quarter of the emitter in turn.
double QuickGather::visible_share(const Emitter& emitter, const Vec3& from, std::uint32_t own,
                                  int rays, Random& random) const {
  const PolygonFrame& frame = emitter.forest->frames()[emitter.k];
  const PatchShape& shape = emitter.forest->node(emitter.k).shape;
  const auto start = random.below(4);
  int seen = 0;
  for (int i = 0; i < rays; ++i) {
    const double r1 = random.uniform(), r2 = random.uniform();
    const int quarter = static_cast<int>((start + static_cast<std::uint64_t>(i)) % 4);
    const Vec3 y = frame.at(shape.point_in_quarter(quarter, r1, r2));
    seen += !solved_.occluders.rays().occluded(from, y, own, emitter.polygon, RayStart::in_air);
  }
  return static_cast<double>(seen) / rays;
}

void QuickGather::add_direct(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                             std::span<double> e) const {
  const Vec3 from = p + 2.0 * solved_.occluders.rays().epsilon_m() * n;
  std::vector<std::pair<double, const Emitter*>> in_view;
  double total = 0.0;
  for (const Emitter& emitter : emitters_) {
    if (emitter.polygon == own) continue;
    const double factor = point_to_polygon(from, n, emitter.corners);
    if (factor <= 0.0) continue;
    in_view.emplace_back(factor, &emitter);
    total += factor * mean_radiosity(*emitter.forest, emitter.k, 0);
  }
  for (const auto& [factor, emitter] : in_view) {
    const bool large =
        factor * mean_radiosity(*emitter->forest, emitter->k, 0) > large_share * total;
    const double seen =
        factor * visible_share(*emitter, from, own, large ? shadow_rays : 1, random);
    for (std::size_t band = 0; band < e.size(); ++band)
      e[band] += seen * mean_radiosity(*emitter->forest, emitter->k, band);
  }
  const LitPlace place{from, n, own, RayStart::in_air};
  for (const LightSource& light : solved_.scene.lights) {
    const int rays = light.opening.empty() ? 1 : shadow_rays;
    for (int i = 0; i < rays; ++i) {
      const double r1 = random.uniform(), r2 = random.uniform();
      const double kernel = light_by_one_ray(light, place, solved_.occluders, r1, r2) / rays;
      for (std::size_t band = 0; band < e.size(); ++band) e[band] += kernel * light.intensity[band];
    }
  }
}

void QuickGather::add_reflected(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                                std::span<double> e) const {
  const Vec3 from = p + 2.0 * solved_.occluders.rays().epsilon_m() * n;
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(rays_))));
  std::vector<double> radiosity(e.size());
  for (int i = 0; i < side * side; ++i) {
    const double r2 = (i / side + random.uniform()) / side;
    const double turn = (i % side + random.uniform()) / side;
    const Vec3 d = cosine_direction(n, r2, turn);
    const RayHit hit = solved_.occluders.rays().closest(from, d, own, 1e30, RayStart::in_air);
    if (!hit.any() || !hit.front || sampler_.contains(hit.polygon)) continue;
    const PolygonRef ref = solved_.occluders.local(hit.polygon);
    const PatchForest& forest = solved_.states[ref.cluster.index()].patches();
    forest.evaluate(true, ref.polygon, from + hit.distance_m * d, radiosity);
    for (std::size_t band = 0; band < e.size(); ++band)
      e[band] += std::max(0.0, radiosity[band]) / (side * side);
  }
}

}  // namespace enfilade
