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

/// Of a point's light. The less noise is asked for, the less is left to rays.
double share_left_to_rays(const PointGatherConfig& config) {
  const double least = config.least_noise();
  return least > 0.0 ? std::clamp(least, 3e-4, 5e-3) : 5e-3;
}

}  // namespace

struct PointGather::Impl {
  std::span<const ClusterState> clusters;
  std::span<const PointLight> lights;
  const Occluders* occluders;
  PointGatherConfig config;
  EmitterSampler bright;
  std::size_t bands;
  Spectrum mean_irradiance;

  void add_lights(const Vec3& p, const Vec3& n, std::uint32_t own, std::span<const double> share,
                  Spectrum& e) const;
  void add_hemisphere(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                      const EmitterSampler::ControlVariate& counted, Spectrum& e) const;
  Spectrum add_rays(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                    const EmitterSampler::ControlVariate& counted, std::span<const double> weights,
                    Spectrum& e) const;
  void add_path(Vec3 from, Vec3 direction, std::uint32_t own, double share,
                std::span<const double> weights, const EmitterSampler::ControlVariate& counted,
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

/// A patch's light, an average over all of it, does for a ray that comes from farther away than
/// this: the side of the square of its area, or more where the patches are known to be worse than
/// 2%, since what it is worth to know better costs noise.
double PointGather::Impl::far_m(const PatchForest& patches, std::uint32_t polygon,
                                const Vec3& at) const {
  const double side_m = std::sqrt(patches.node(patches.leaf_at(polygon, at)).shape.area_m2);
  return side_m * std::clamp(config.patch_error / 0.02, 1.0, 4.0);
}

/// Adds share * what a ray brings. Where it ends near a patch, the patch's light is an average over
/// more than what is seen from here (a gap below a cupboard, a corner);
/// from such a point the light is sought again, with one ray at random, and so on. Only
/// what differs from what is counted in that direction already.
void PointGather::Impl::add_path(Vec3 from, Vec3 direction, std::uint32_t own, double share,
                                 std::span<const double> weights,
                                 const EmitterSampler::ControlVariate& counted, Random& random,
                                 Spectrum& e) const {
  std::vector<double> carried(bands, share), radiosity(bands);
  for (int bounces = 0; bounces < 64; ++bounces) {
    const RayHit hit = occluders->rays().closest(from, direction, own, 1e30, RayStart::in_air);
    const bool ends = !hit.any() || !hit.front;
    const auto* is_counted = bounces == 0 && !ends ? counted.find(hit.polygon) : nullptr;
    for (std::size_t b = 0; b < bands && bounces == 0 && is_counted == nullptr; ++b) {
      e[b] -= share * counted.ambient[b];
    }
    if (ends || (bright.contains(hit.polygon) && is_counted == nullptr)) return;
    const PolygonRef ref = occluders->local(hit.polygon);
    const PatchForest& patches = clusters[ref.cluster.index()].patches();
    const Vec3 at = from + hit.distance_m * direction;
    const VisibleNode* seen =
        is_counted != nullptr ? node_around(is_counted->nodes, patches, ref.polygon, at) : nullptr;
    for (std::size_t b = 0; b < bands && seen != nullptr; ++b) {
      e[b] -= share * seen->radiosity(patches, b, at);
    }
    if (hit.distance_m > far_m(patches, ref.polygon, at) || bright.contains(hit.polygon)) {
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
    // Faint paths end by lot, and those that go on stand for them (Arvo and Kirk 1990).
    const double survival = std::min(1.0, most / (0.05 * share));
    if (random.uniform() >= survival) return;
    for (double& c : carried) c /= survival;
    own = hit.polygon;
    from = at + 2.0 * occluders->rays().epsilon_m() * frame.n;
    bright.add_one(from, frame.n, own, weights, random, carried, e);
    add_lights(from, frame.n, own, carried, e);
    const double r2 = random.uniform(), turn = random.uniform();
    direction = cosine_direction(frame.n, r2, turn);
  }
}

/// Cosine-weighted rays, one in each stratum of the disc below the hemisphere (Nusselt). Returns
/// the variance of what they bring, from the differences between neighbouring strata.
Spectrum PointGather::Impl::add_rays(const Vec3& p, const Vec3& n, std::uint32_t own,
                                     Random& random, const EmitterSampler::ControlVariate& counted,
                                     std::span<const double> weights, Spectrum& e) const {
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(config.rays))));
  Spectrum variance(bands, 0.0), one(bands), before(bands);
  const int pairs = side * side / 2;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double r2 = (i + random.uniform()) / side, turn = (j + random.uniform()) / side;
      std::fill(one.begin(), one.end(), 0.0);
      add_path(p, cosine_direction(n, r2, turn), own, 1.0 / (side * side), weights, counted, random,
               one);
      for (std::size_t b = 0; b < bands; ++b) {
        e[b] += one[b];
        if ((i * side + j) % 2 == 1) variance[b] += (one[b] - before[b]) * (one[b] - before[b]);
      }
      before = one;
    }
  }
  // A ray left over is taken for as noisy as the others; a single one for as noisy as can be.
  for (double& v : variance) {
    v = pairs > 0 ? v * side * side / (2.0 * pairs) : std::numeric_limits<double>::infinity();
  }
  return variance;
}

/// Everything else, by rays, and by more of them where there is much noise in what they bring.
void PointGather::Impl::add_hemisphere(const Vec3& p, const Vec3& n, std::uint32_t own,
                                       Random& random,
                                       const EmitterSampler::ControlVariate& counted,
                                       Spectrum& e) const {
  const std::vector<double> weights = bright.weights_near(p);
  Spectrum sum(bands, 0.0), variance(bands, 0.0);
  const double least = config.least_noise();
  bool noisy = true;
  int rounds = 0;
  while (noisy && rounds < 16) {
    const Spectrum more = add_rays(p, n, own, random, counted, weights, sum);
    ++rounds;
    noisy = false;
    for (std::size_t b = 0; b < bands; ++b) {
      variance[b] += more[b];
      const double light = e[b] + sum[b] / rounds;
      noisy |= least > 0.0 &&
               std::sqrt(variance[b]) / rounds > std::max(least * light, 1e-4 * mean_irradiance[b]);
    }
  }
  for (std::size_t b = 0; b < bands; ++b) e[b] += sum[b] / rounds;
}

/// The polygon that p lies on with the same facing, within the rays' blind distance; else none. Of
/// several in one place the lowest number.
std::uint32_t PointGather::Impl::surface_at(const Vec3& p, const Vec3& n) const {
  for (const std::uint32_t k : occluders->touching(p, 4.0 * occluders->rays().epsilon_m())) {
    if (glm::dot(normal(occluders->polygon(k)), n) > 0.999) return k;
  }
  return RayScene::no_polygon;
}

/// Off the surface and off walls that stand up beside it, so that a corner's walls stay on their
/// side: in a corner the light is what it is just before it.
Vec3 PointGather::Impl::lifted(const Vec3& p, const Vec3& n) const {
  const double step_m = 2.0 * occluders->rays().epsilon_m();
  const Vec3 above = p + step_m * n;
  std::vector<Vec3> away;
  for (const std::uint32_t k : occluders->touching(p, step_m)) {
    const Polygon& wall = occluders->polygon(k);
    const bool rises = std::any_of(
        wall.begin(), wall.end(), [&](const Vec3& v) { return glm::dot(n, v - p) > 4.0 * step_m; });
    const Plane plane = plane_of(wall);
    // Between walls back to back there is no telling which side is meant: the first in the file's.
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
  // The same point gives the same answer, whichever points were asked before it.
  Random random(impl_->config.seed);
  Spectrum e(impl_->bands, 0.0);
  const std::uint32_t own = impl_->surface_at(p, n);
  const Vec3 x = impl_->lifted(p, n);
  const EmitterSampler::ControlVariate counted =
      impl_->bright.add_largest(x, n, own, share_left_to_rays(impl_->config), e);
  impl_->add_lights(x, n, own, std::vector<double>(impl_->bands, 1.0), e);
  impl_->add_hemisphere(x, n, own, random, counted, e);
  // What is counted at first and taken away ray by ray leaves its rounding behind.
  for (std::size_t b = 0; b < impl_->bands; ++b) {
    if (e[b] < 1e-12 * counted.ambient[b]) e[b] = 0.0;
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
