#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"
#include "report/pictures/gathered_light.hpp"

namespace enfilade {
namespace {

/// Of a place's light from bright emitters if nothing hid them: one that gives less is small.
constexpr double large_share = 0.05;
/// To each large emitter, and to all small ones together.
constexpr int shadow_rays = 6;
/// Rays to a dome of the sky, in as many strata, for each ray over the hemisphere: a window shows
/// only a part of the sky.
constexpr int sky_rays_per_ray = 4;

}  // namespace

QuickGather::QuickGather(const SolvedScene& solved, int rays)
    : solved_(solved), rays_(rays), sampler_(solved.states, solved.occluders) {}

/// Adds `weight` times its light, where it is seen: by one ray to each quarter of the emitter in
/// turn.
void QuickGather::add_emitter(const EmitterSampler::Emitter& emitter, const LitPlace& place,
                              double weight, int rays, Random& random, std::span<double> e) const {
  const double factor = weight * point_to_polygon(place.x, place.n, emitter.corners) / rays;
  if (factor <= 0.0) return;
  const auto start = random.below(4);
  for (int i = 0; i < rays; ++i) {
    const double r1 = random.uniform(), r2 = random.uniform();
    const int quarter = static_cast<int>((start + static_cast<std::uint64_t>(i)) % 4);
    const Vec3 y = emitter.frame().at(emitter.shape().point_in_quarter(quarter, r1, r2));
    const Passage passage =
        solved_.occluders.passage(place.x, y, place.own, emitter.polygon, place.start);
    if (passage.share <= 0.0) continue;
    for (std::size_t band = 0; band < e.size(); ++band)
      e[band] += factor * passage.band(band) * emitter.radiosity(band);
  }
}

void QuickGather::add_bright(const LitPlace& place, Random& random, std::span<double> e) const {
  const std::span<const EmitterSampler::Emitter> bright = sampler_.bright();
  const std::vector<double> light = sampler_.bright_unoccluded(place.x, place.n, place.own);
  const double large = large_share * std::accumulate(light.begin(), light.end(), 0.0);
  double of_small = 0.0;
  for (std::size_t i = 0; i < bright.size(); ++i) {
    if (light[i] > large) {
      add_emitter(bright[i], place, 1.0, shadow_rays, random, e);
    } else {
      of_small += light[i];
    }
  }
  // Systematic sampling: picks at even distances along the small ones' light.
  const double step = of_small / shadow_rays;
  double next = random.uniform() * step, passed = 0.0;
  for (std::size_t i = 0; i < bright.size() && of_small > 0.0; ++i) {
    if (light[i] > large) continue;
    passed += light[i];
    for (; next < passed; next += step)
      add_emitter(bright[i], place, step / light[i], 1, random, e);
  }
}

void QuickGather::add_direct(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                             std::span<double> e) const {
  const Vec3 from = p + 2.0 * solved_.occluders.rays().epsilon_m() * n;
  const LitPlace place{from, n, own, RayStart::in_air};
  add_bright(place, random, e);
  for (const LightSource& light : solved_.scene.lights) {
    if (light.sky) continue;
    const int rays = light.opening.empty() ? 1 : shadow_rays;
    for (int i = 0; i < rays; ++i) {
      const double r1 = random.uniform(), r2 = random.uniform();
      const LightAtPoint found = light_by_one_ray(light, place, solved_.occluders, r1, r2);
      for (std::size_t band = 0; band < e.size(); ++band)
        e[band] += found.band(band) / rays * light.intensity[band];
    }
  }
}

/// The facets of a dome follow each other in space, so that strata of their list are parts of it.
void QuickGather::add_sky(const LitPlace& place, Random& random, std::span<double> e) const {
  for (const LightSource& light : solved_.scene.lights) {
    if (!light.sky) continue;
    const int sky_rays = sky_rays_per_ray * rays_;
    for (int i = 0; i < sky_rays; ++i) {
      const double r1 = (i + random.uniform()) / sky_rays, r2 = random.uniform();
      const LightAtPoint found = light_by_one_ray(light, place, solved_.occluders, r1, r2);
      for (std::size_t band = 0; band < e.size(); ++band)
        e[band] += found.band(band) / sky_rays * light.intensity[band];
    }
  }
}

void QuickGather::add_reflected(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                                std::span<double> e) const {
  const Vec3 from = p + 2.0 * solved_.occluders.rays().epsilon_m() * n;
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(rays_))));
  std::vector<double> radiosity(e.size());
  add_sky({from, n, own, RayStart::in_air}, random, e);
  for (int i = 0; i < side * side; ++i) {
    const double r2 = (i / side + random.uniform()) / side;
    const double turn = (i % side + random.uniform()) / side;
    const Vec3 d = cosine_direction(n, r2, turn);
    const RayHit hit = solved_.occluders.rays().closest(from, d, own, 1e30, RayStart::in_air);
    Passage passage;
    const auto add = [&](std::uint32_t polygon, double distance_m, const Passage& through) {
      if (sampler_.contains(polygon)) return;
      const PolygonRef ref = solved_.occluders.local(polygon);
      const PatchForest& forest = solved_.states[ref.cluster.index()].patches();
      forest.evaluate(true, ref.polygon, from + distance_m * d, radiosity);
      for (std::size_t band = 0; band < e.size(); ++band)
        e[band] += through.band(band) * std::max(0.0, radiosity[band]) / (side * side);
    };
    if (solved_.occluders.panes().any()) {
      const double distance_m = hit.any() ? hit.distance_m : far_away_m;
      for (const PaneMet& pane :
           solved_.occluders.panes_along(from, d, distance_m, own, RayStart::in_air)) {
        if (pane.front) add(pane.polygon, pane.distance_m, pane.before);
        passage = pane.behind;
      }
    }
    if (hit.any() && hit.front) add(hit.polygon, hit.distance_m, passage);
  }
}

}  // namespace enfilade
