// The estimate of a link from a far node: a node of the building's tree, whose polygons are not in
// memory. The power that arrives is estimated by Monte Carlo, each sample divided by its
// probability: a far link carries little, but there are many, and a bias of each would add up. Two
// limits bias it a little, for the sake of stability: of the form factor of a sample without a ray
// (1), and of the transport of reflected light per form factor (reflected_transport).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"
#include "links/far_samples/far_sample.hpp"
#include "links/link_estimate.hpp"

namespace enfilade {
namespace {

/// Samples by the bound of the power, as multiples of the tolerance.
constexpr int few_samples = 1, more_samples = 4, most_samples = 16;
constexpr double few_share = 0.1, more_share = 4.0;
/// Standard deviation of a single sample, as a share of the unoccluded power.
constexpr double one_sample_deviation = 0.5;
/// Samples that are all hidden, or all turned away: the power (by its bound) of this share of a
/// sample may arrive, by Jeffreys.
constexpr double unseen_samples = 0.5;
/// Error by the change of what a far node sends among its parts, per unit of their deviation.
constexpr double far_variation = 0.1;
/// A node that sends nearly nothing towards the receiver's middle may light its ends: errors are
/// relative to at least this share of the radiosity of its brightest polygon.
constexpr double least_light_share = 1e-3;

/// A point of a receiver, and the polygon that it lies on.
struct ReceiverPoint {
  Vec3 x, n;
  std::uint32_t polygon = 0;
};

/// The polygon by area, the place by stratum `k` of `strata`.
ReceiverPoint point_of(const LinkSide& receiver, int k, int strata, Random& random) {
  const PatchForest& forest = *receiver.forest;
  if (!receiver.is_group()) {
    const PolygonFrame& frame = receiver.frame();
    const double r1 = random.uniform(), r2 = random.uniform();
    const int quarter = strata < 4 ? static_cast<int>(random.below(4)) : k % 4;
    return {frame.at(receiver.shape.point_in_quarter(quarter, r1, r2)), frame.n, receiver.id.root};
  }
  const GroupNode& group = receiver.group();
  double pick = receiver.area_m2 * (k + random.uniform()) / strata;
  std::uint32_t i = group.begin;
  for (; i + 1 < group.end; ++i) {
    const double m2 = forest.node(forest.order()[i]).shape.area_m2;
    if (pick < m2) break;
    pick -= m2;
  }
  const std::uint32_t polygon = forest.order()[i];
  const PatchShape& shape = forest.node(polygon).shape;
  const double r1 = random.uniform(), r2 = random.uniform();
  const Vec2 p =
      uniform_point({shape.vertices.data(), shape.vertices.size()}, shape.area_m2, r1, r2);
  return {forest.frames()[polygon].at(p), forest.frames()[polygon].n, polygon};
}

/// Sums of the samples' irradiance: of all, and of the visible ones with their squares.
struct Sums {
  double all = 0.0, seen = 0.0, seen2 = 0.0, emitted = 0.0, factor = 0.0;
  int samples = 0, hidden = 0;
  TintSum tint{};
  /// Returns the irradiance that arrives.
  double add(const FarSample& sample, const Passage& passage) {
    const double irradiance = sample.emitted + sample.reflected;
    all += irradiance;
    if (passage.share <= 0.0) return 0.0;
    tint.add(irradiance, passage);
    seen += passage.share * irradiance;
    emitted += passage.share * sample.emitted;
    factor += passage.share * sample.factor;
    return passage.share * irradiance;
  }
  double deviation_of_mean() const {
    const double mean = seen / samples;
    return std::sqrt(std::max(0.0, seen2 / samples - mean * mean) / std::max(1, samples - 1));
  }
};

/// The van der Corput sequence in base 2: the bits of k behind the binary point, in reverse.
double radical_inverse(int k) {
  double sum = 0.0;
  for (double digit = 0.5; k > 0; k /= 2, digit *= 0.5) sum += k % 2 == 1 ? digit : 0.0;
  return sum;
}

/// Samples pairs of points, the receiver's and the far node's, with a ray between them.
struct FarSampler {
  const LinkSide& receiver;
  const LinkSide& shooter;
  const Occluders& occluders;
  WorkCount& work;
  Random random;
  /// Of the receiver alone, so that each of its rays ends in one of the nodes around it: what one
  /// node's rays find too much, its neighbours' find too little, and the sum over all is right.
  Random ray_random;
  Sums sums{};
  /// Where the node surrounds or touches the receiver, a point of it may lie so near that it stands
  /// for more than all light: there a ray is drawn as well.
  bool with_rays = gap_m(receiver.bounds, shooter.bounds) <= 0.0;
  double ray_shift = ray_random.uniform();

  /// Adds `count` samples, stratified over the receiver and over the node's clusters.
  void add(int count) {
    const auto shift = static_cast<int>(random.below(static_cast<std::uint64_t>(count)));
    for (int k = 0; k < count; ++k) {
      const int stratum = (k + shift) % count;
      const ReceiverPoint p = point_of(receiver, k, count, random);
      const std::uint32_t own = occluders.global(receiver.cluster, p.polygon);
      ++work.kernels;
      ++sums.samples;
      double seen = 0.0;
      const FarSample s =
          point_of_node(*shooter.far, shooter.id.group(), p.x, p.n,
                        (stratum + random.uniform()) / count, with_rays, occluders, random);
      if (s.factor > 0.0) {
        ++work.rays;
        const Passage passage = occluders.passage(p.x, s.y, own, s.polygon);
        if (passage.share <= 0.0) ++sums.hidden;
        seen += sums.add(s, passage);
      }
      if (with_rays) seen += add_ray(k);
      sums.seen2 += seen * seen;
    }
  }
  /// Returns the irradiance that ray k brings: the first n rays of a receiver are the same for all
  /// nodes, whatever n is.
  double add_ray(int k) {
    const ReceiverPoint p = point_of(receiver, 0, 1, ray_random);
    const std::uint32_t own = occluders.global(receiver.cluster, p.polygon);
    const double turn = ray_random.uniform();
    const Vec3 d = cosine_direction(p.n, std::fmod(ray_shift + radical_inverse(k), 1.0), turn);
    ++work.rays;
    const FarSample end = end_of_ray(*shooter.far, shooter.id.group(), p.x, p.n, d, own, occluders);
    if (end.factor <= 0.0) return 0.0;
    return sums.add(end, occluders.dimmed(p.x, d, glm::distance(p.x, end.y), own));
  }
};

/// Irradiance per unit of the node's reflected radiosity, in which what is seen of the node may be
/// brighter or darker than its mean. Within limits: light that grows must not grow by more than it
/// can, or the iteration diverges.
double reflected_transport(double irradiance, double factor, const LinkSide& shooter) {
  constexpr double least = 0.5, most = 2.0;
  const BuildingLight& light = shooter.far->light();
  double radiosity = 0.0;
  for (std::size_t b = 0; b < light.bands(); ++b) {
    radiosity = std::max(radiosity, light.reflected(shooter.id.group(), b, shooter.toward));
  }
  return radiosity > 0.0 ? std::clamp(irradiance / radiosity, least * factor, most * factor)
                         : factor;
}

double worst_exitance(const BuildingLight& light, std::uint32_t node) {
  double worst = 0.0;
  for (std::size_t b = 0; b < light.bands(); ++b) worst = std::max(worst, light.emitted(node, b));
  return worst;
}

/// Area of a group's polygons that light reaches, times their cosines to `toward`; 0 = from all
/// sides.
double receiving_area(const LinkSide& receiver, const Vec3& toward) {
  double m2 = 0.0;
  const GroupNode& group = receiver.group();
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const std::uint32_t k = receiver.forest->order()[i];
    if (receiver.forest->unreachable(k)) continue;
    const double cosine = glm::dot(receiver.forest->frames()[k].n, toward);
    m2 += receiver.forest->node(k).shape.area_m2 *
          (toward == Vec3(0.0) ? 1.0 : std::max(0.0, cosine));
  }
  return m2;
}

}  // namespace

/// The receiver's power is that of the samples; a patch distributes it evenly, a group by the
/// cosines to the node's middle, or evenly where the node is around it.
LinkEstimate LinkEstimator::evaluate_far(const LinkSide& receiver, const LinkSide& shooter,
                                         double tolerance) {
  LinkEstimate out;
  out.sampled = true;
  const Vec3 d = shooter.center - receiver.center;
  const double distance = glm::length(d);
  FarSampler sampler{receiver,
                     shooter,
                     *occluders_,
                     *work_,
                     Random(LinkSide::seed_of(receiver, shooter) + draw_),
                     Random(LinkSide::seed_of(receiver, receiver) + draw_)};
  const double bound = power_bound(receiver, shooter);
  const Sums& sums = sampler.sums;
  // By the bound alone: a number of samples that followed from samples would bias their mean.
  sampler.add(bound <= few_share * tolerance    ? few_samples
              : bound <= more_share * tolerance ? more_samples
                                                : most_samples);

  const BuildingLight& building = shooter.far->light();
  const std::uint32_t node = shooter.id.group();
  const double mean = sums.seen / sums.samples, all = sums.all / sums.samples;
  const double light = std::max(shooter.light, least_light_share * building.most(node));
  // Portals let pass no more than this share of the unoccluded power, were all the node as bright
  // as its brightest polygon.
  const double most = shooter.portal_m2 * building.most(node);
  const double passing = all > 0.0 ? std::min(1.0, most / (receiver.area_m2 * all)) : 1.0;
  double deviation =
      sums.samples > 1 ? sums.deviation_of_mean() : one_sample_deviation * std::sqrt(passing) * all;
  if (sums.hidden > 0) {
    const double unseen = unseen_samples * std::min(1.0, std::sqrt(passing * sums.samples));
    deviation = std::max(deviation, unseen * all / sums.samples);
  }
  if (sums.all <= 0.0) deviation = unseen_samples * bound / (receiver.area_m2 * sums.samples);
  out.tint = sums.tint.mean();
  if (light <= 0.0) return out;
  out.shooter_error = receiver.area_m2 * deviation / light;
  out.variation = far_variation * receiver.area_m2 * mean / light;
  // A group receives in proportion to its polygons' cosines to the node's middle, and from a node
  // around it from all sides.
  double scale = 1.0;
  if (receiver.is_group()) {
    const Vec3 toward = sampler.with_rays ? Vec3(0.0) : d / distance;
    const double m2 = receiving_area(receiver, toward);
    if (m2 <= 0.0) return out;
    scale = receiver.area_m2 / m2;
    out.transport = {0.0f, static_cast<float>(toward.x), static_cast<float>(toward.y),
                     static_cast<float>(toward.z)};
  }
  const FarTerms terms = FarTerms::of(receiver.is_group());
  const double factor = sums.factor / sums.samples, emitted = sums.emitted / sums.samples;
  out.transport[0] =
      static_cast<float>(scale * reflected_transport(mean - emitted, factor, shooter));
  out.transport[terms.factor] = static_cast<float>(scale * factor);
  const double exitance = worst_exitance(building, node);
  if (exitance > 0.0) out.transport[terms.emitted] = static_cast<float>(scale * emitted / exitance);
  return out;
}

}  // namespace enfilade
