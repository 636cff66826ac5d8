#include "final_gather/point_gather.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.hpp"
#include "final_gather/emitter_sampler.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

Spectrum mean_over(std::span<const ClusterState> clusters) {
  Spectrum mean(clusters.empty() ? 1 : static_cast<std::size_t>(clusters[0].bands()), 0.0);
  double area = 0.0;
  for (const ClusterState& cluster : clusters) {
    const PatchForest& patches = cluster.patches();
    for (std::size_t k = 0; k < patches.polygons(); ++k) {
      area += patches.node(k).shape.area_m2;
      for (std::size_t b = 0; b < mean.size(); ++b) {
        mean[b] += patches.node(k).shape.area_m2 *
                   patches.irradiance(k)[b * static_cast<std::size_t>(patches.terms())];
      }
    }
  }
  for (double& m : mean) m = area > 0.0 ? m / area : 0.0;
  return mean;
}

/// Polygons that may give a smaller share of a point's light than this are left to the rays. The
/// less noise is asked for, the smaller the share.
double share_left_to_rays(const PointGatherConfig& config) {
  constexpr double least_share = 3e-4, most_share = 5e-3;
  const double noise = config.least_noise();
  return noise > 0.0 ? std::clamp(noise, least_share, most_share) : most_share;
}

/// Error of the patches at which a patch's light is read off from one patch side away.
constexpr double usual_patch_error = 0.02;
/// Paths that carry less than this share of what they began with end by chance.
constexpr double faint = 0.05;
constexpr int most_bounces = 64;
/// Sets of rays for one point, each of PointGatherConfig::rays.
constexpr int most_ray_sets = 16;
/// Noise below this share of the scene's mean irradiance does not matter.
constexpr double unseen_noise = 1e-4;
/// Of the ambient light: what is left after the control variate is added and subtracted again.
constexpr double rounding = 1e-12;

}  // namespace

struct PointGather::Impl {
  std::span<const ClusterState> clusters;
  std::span<const PointLight> lights;
  const Occluders* occluders;
  PointGatherConfig config;
  EmitterSampler emitters;
  std::size_t bands;
  Spectrum mean_irradiance;

  void add_lights(const Vec3& p, const Vec3& n, std::uint32_t own, std::span<const double> share,
                  Spectrum& e) const;
  void add_hemisphere(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                      const EmitterSampler::ControlVariate& control, Spectrum& e) const;
  Spectrum add_rays(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                    const EmitterSampler::ControlVariate& control, std::span<const double> weights,
                    Spectrum& e) const;
  void add_path(Vec3 from, Vec3 direction, std::uint32_t own, double share,
                std::span<const double> weights, const EmitterSampler::ControlVariate& control,
                Random& random, Spectrum& e) const;
  double far_m(const PatchForest& patches, std::uint32_t polygon, const Vec3& at) const;
  std::uint32_t surface_at(const Vec3& p, const Vec3& n) const;
  Vec3 lifted(const Vec3& p, const Vec3& n) const;
};

void PointGather::Impl::add_lights(const Vec3& p, const Vec3& n, std::uint32_t own,
                                   std::span<const double> share, Spectrum& e) const {
  for (const PointLight& light : lights) {
    const Vec3 d = light.p - p;
    const double r2 = glm::dot(d, d), cosine = glm::dot(d, n);
    if (cosine <= 0.0 ||
        occluders->rays().occluded(p, light.p, own, RayScene::no_polygon, RayStart::in_air))
      continue;
    for (std::size_t band = 0; band < bands; ++band) {
      e[band] += share[band] * light.intensity[band] * cosine / (r2 * std::sqrt(r2));
    }
  }
}

/// Distance from which a ray may read the light off the patch that it ends on, which is an average
/// over the patch: the side of the square of its area. More where the patches' error is larger than
/// usual, up to 4 times, since following the light on costs noise.
double PointGather::Impl::far_m(const PatchForest& patches, std::uint32_t polygon,
                                const Vec3& at) const {
  const double side_m = std::sqrt(patches.node(patches.leaf_at(polygon, at)).shape.area_m2);
  return side_m * std::clamp(config.patch_error / usual_patch_error, 1.0, 4.0);
}

/// Adds share * (the radiosity that a ray finds less the control variate in its direction). Where a
/// ray ends on a patch that is large for its distance (a gap below a cupboard, a corner), the
/// patch's mean is not the radiosity at the ray's end: the path goes on from the end with one
/// random ray, and with direct light there, and so on.
void PointGather::Impl::add_path(Vec3 from, Vec3 direction, std::uint32_t own, double share,
                                 std::span<const double> weights,
                                 const EmitterSampler::ControlVariate& control, Random& random,
                                 Spectrum& e) const {
  std::vector<double> carried(bands, share), radiosity(bands);
  for (int bounces = 0; bounces < most_bounces; ++bounces) {
    const RayHit hit = occluders->rays().closest(from, direction, own, 1e30, RayStart::in_air);
    const bool ends = !hit.any() || !hit.front;
    const auto* controlled = bounces == 0 && !ends ? control.find(hit.polygon) : nullptr;
    for (std::size_t b = 0; b < bands && bounces == 0 && controlled == nullptr; ++b) {
      e[b] -= share * control.ambient[b];
    }
    if (ends || (emitters.contains(hit.polygon) && controlled == nullptr)) return;
    const PolygonRef ref = occluders->local(hit.polygon);
    const PatchForest& patches = clusters[ref.cluster.index()].patches();
    const Vec3 at = from + hit.distance_m * direction;
    const VisibleNode* node =
        controlled != nullptr ? node_around(controlled->nodes, patches, ref.polygon, at) : nullptr;
    for (std::size_t b = 0; b < bands && node != nullptr; ++b) {
      e[b] -= share * node->radiosity(patches, b, at);
    }
    if (hit.distance_m > far_m(patches, ref.polygon, at) || emitters.contains(hit.polygon)) {
      patches.evaluate(true, ref.polygon, at, radiosity);
      for (std::size_t b = 0; b < bands; ++b) e[b] += carried[b] * radiosity[b];
      return;
    }
    const PolygonFrame& frame = patches.frames()[ref.polygon];
    double most = 0.0;
    for (std::size_t b = 0; b < bands; ++b) {
      e[b] += carried[b] * frame.exitance[b];
      carried[b] *= frame.reflectance[b];
      most = std::max(most, carried[b]);
    }
    // Russian roulette (Arvo and Kirk 1990).
    const double survival = std::min(1.0, most / (faint * share));
    if (random.uniform() >= survival) return;
    for (double& c : carried) c /= survival;
    own = hit.polygon;
    from = at + 2.0 * occluders->rays().epsilon_m() * frame.n;
    emitters.add_picked(from, frame.n, own, weights, random, carried, e);
    add_lights(from, frame.n, own, carried, e);
    const double r2 = random.uniform(), turn = random.uniform();
    direction = cosine_direction(frame.n, r2, turn);
  }
}

/// Adds the mean of a set of cosine-weighted rays, one in each stratum of the disc below the
/// hemisphere (Nusselt). Returns its variance per band, from the differences between neighbouring
/// strata.
Spectrum PointGather::Impl::add_rays(const Vec3& p, const Vec3& n, std::uint32_t own,
                                     Random& random, const EmitterSampler::ControlVariate& control,
                                     std::span<const double> weights, Spectrum& e) const {
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(config.rays))));
  Spectrum variance(bands, 0.0), one(bands), before(bands);
  const int pairs = side * side / 2;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double r2 = (i + random.uniform()) / side, turn = (j + random.uniform()) / side;
      std::fill(one.begin(), one.end(), 0.0);
      add_path(p, cosine_direction(n, r2, turn), own, 1.0 / (side * side), weights, control, random,
               one);
      for (std::size_t b = 0; b < bands; ++b) {
        e[b] += one[b];
        if ((i * side + j) % 2 == 1) variance[b] += (one[b] - before[b]) * (one[b] - before[b]);
      }
      before = one;
    }
  }
  // An odd ray is assumed to be as noisy as the pairs are. A single ray says nothing about noise.
  for (double& v : variance) {
    v = pairs > 0 ? v * side * side / (2.0 * pairs) : std::numeric_limits<double>::infinity();
  }
  return variance;
}

/// Adds the integral of radiosity less control variate over the hemisphere: the mean of several
/// sets of rays, until the noise is low enough.
void PointGather::Impl::add_hemisphere(const Vec3& p, const Vec3& n, std::uint32_t own,
                                       Random& random,
                                       const EmitterSampler::ControlVariate& control,
                                       Spectrum& e) const {
  const std::vector<double> weights = emitters.pick_weights(p);
  Spectrum sum(bands, 0.0), variance(bands, 0.0);
  const double least = config.least_noise();
  bool noisy = true;
  int rounds = 0;
  while (noisy && rounds < most_ray_sets) {
    const Spectrum more = add_rays(p, n, own, random, control, weights, sum);
    ++rounds;
    noisy = false;
    for (std::size_t b = 0; b < bands; ++b) {
      variance[b] += more[b];
      const double light = e[b] + sum[b] / rounds;
      noisy |= least > 0.0 && std::sqrt(variance[b]) / rounds >
                                  std::max(least * light, unseen_noise * mean_irradiance[b]);
    }
  }
  for (std::size_t b = 0; b < bands; ++b) e[b] += sum[b] / rounds;
}

/// The polygon (global number, the lowest of several) that p lies on, to within the distance that
/// rays skip at their start, and that faces the same way; else none.
std::uint32_t PointGather::Impl::surface_at(const Vec3& p, const Vec3& n) const {
  for (const std::uint32_t k : occluders->touching(p, 4.0 * occluders->rays().epsilon_m())) {
    if (glm::dot(normal(occluders->polygon(k)), n) > 0.999) return k;
  }
  return RayScene::no_polygon;
}

/// p moved off its surface, and off the walls that rise beside it: at the edge of a floor the
/// point would else lie behind the wall, where it is dark.
Vec3 PointGather::Impl::lifted(const Vec3& p, const Vec3& n) const {
  const double step_m = 2.0 * occluders->rays().epsilon_m();
  const Vec3 above = p + step_m * n;
  std::vector<Vec3> away;
  for (const std::uint32_t k : occluders->touching(p, step_m)) {
    const Polygon& wall = occluders->polygon(k);
    const bool rises = std::any_of(
        wall.begin(), wall.end(), [&](const Vec3& v) { return glm::dot(n, v - p) > 4.0 * step_m; });
    const Plane plane = plane_of(wall);
    // Between two walls back to back either side may be meant: that of the first in the file.
    const bool opposed = std::any_of(away.begin(), away.end(),
                                     [&](const Vec3& o) { return glm::dot(plane.n, o) < -0.999; });
    if (rises && !opposed && plane.signed_distance(above) < step_m) away.push_back(plane.n);
  }
  Vec3 x = above;
  for (const Vec3& m : away) {
    const double short_m = step_m - glm::dot(m, x - above);
    if (short_m > 0.0) x += short_m * m;
  }
  return x;
}

PointGather::PointGather(std::span<const ClusterState> clusters, std::span<const PointLight> lights,
                         const Occluders& occluders, const PointGatherConfig& config)
    : impl_(std::make_unique<Impl>(
          Impl{clusters, lights, &occluders, config, EmitterSampler(clusters, occluders),
               clusters.empty() ? 1 : static_cast<std::size_t>(clusters[0].bands()),
               mean_over(clusters)})) {}

PointGather::~PointGather() = default;

Spectrum PointGather::irradiance(const Vec3& p, const Vec3& n) const {
  // Seeded for each point: the answer does not depend on the points before it.
  Random random(impl_->config.seed);
  Spectrum e(impl_->bands, 0.0);
  const std::uint32_t own = impl_->surface_at(p, n);
  const Vec3 x = impl_->lifted(p, n);
  const EmitterSampler::ControlVariate control =
      impl_->emitters.add_control_variate(x, n, own, share_left_to_rays(impl_->config), e);
  impl_->add_lights(x, n, own, std::vector<double>(impl_->bands, 1.0), e);
  impl_->add_hemisphere(x, n, own, random, control, e);
  for (std::size_t b = 0; b < impl_->bands; ++b) {
    if (e[b] < rounding * control.ambient[b]) e[b] = 0.0;
  }
  return e;
}

Spectrum PointGather::from_patches(const Vec3& p, const Vec3& n) const {
  Spectrum e(impl_->bands, 0.0);
  std::uint32_t polygon = impl_->surface_at(p, n);
  if (polygon == RayScene::no_polygon) {
    const RayHit hit = impl_->occluders->rays().closest(p, -n);
    if (!hit.any() || !hit.front) return e;
    polygon = hit.polygon;
  }
  const PolygonRef ref = impl_->occluders->local(polygon);
  impl_->clusters[ref.cluster.index()].patches().evaluate(false, ref.polygon, p, e);
  return e;
}

Spectrum PointGather::radiosity(std::uint32_t polygon, const Vec3& p) const {
  Spectrum b(impl_->bands, 0.0);
  const PolygonRef ref = impl_->occluders->local(polygon);
  impl_->clusters[ref.cluster.index()].patches().evaluate(true, ref.polygon, p, b);
  return b;
}

}  // namespace enfilade
