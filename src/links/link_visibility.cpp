// Which method a pair's visibility takes, and visibility by rays (the exact one:
// exact_visibility.cpp).
#include "links/link_visibility.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

/// The exact method cuts against at most so many occluders: its cost is their number times the
/// visible parts, and rays cost the same whatever their number.
constexpr std::size_t most_occluders = 16;
/// A list of at most so many occluders is kept for the parts of a link, which then search it
/// instead of all polygons.
constexpr std::size_t most_listed = 32;

/// Below this share of the tolerance the power is too small for its visibility to matter: one ray.
constexpr double one_ray_share = 0.1;
// Uncertainties of the mean visibility, as shares of the power.
constexpr double one_ray_uncertainty = 0.5;     ///< largest standard deviation of one yes or no
constexpr double four_rays_uncertainty = 0.25;  ///< of the mean of four: 0.5 / sqrt(4)
constexpr double agreeing_uncertainty = 0.1;    ///< four that agree, by Jeffreys: 0.5 / (4 + 1)

/// The uncertainty of a share of which 16 rays found `open` open. Where all rays agree: the share
/// of the other answer by Jeffreys' estimate (k + 1/2) / (n + 1); else the standard deviation.
double uncertainty_of_16(int open) {
  const double p = (open + 0.5) / 17.0;
  return open == 0 || open == 16 ? p < 0.5 ? p : 1.0 - p : std::sqrt(p * (1.0 - p) / 16.0);
}

double mean_of(const std::array<double, 4>& at) { return 0.25 * (at[0] + at[1] + at[2] + at[3]); }

/// A shaft's ends are points or flat: not a light's corners that hold several polygons.
bool one_flat_side(const LinkSide& light) {
  return light.part->is_point() || light.part->is_one_polygon();
}

/// The shooter's quarter that the first ray from a receiver's quarter goes to: a permutation.
int first_partner(int quarter) { return (quarter * 3 + 1) % 4; }

}  // namespace

/// Rays from random points in quarters of a receiving patch.
struct LinkVisibility::QuarterRays {
  LinkVisibility& visibility;
  const LinkSide& receiver;
  const LinkSide& shooter;
  std::span<const double> group_factors;
  std::uint32_t own;  ///< global number of the receiver's polygon
  Random random;

  double dimmed2 = 0.0;  ///< sum of the squares of what the panes keep from open rays

  /// Returns the share that passes.
  double ray(int quarter, int shooter_quarter, std::uint32_t* blocker, PairVisibility& v) {
    const Vec3 x = receiver.frame().at(
        receiver.shape.point_in_quarter(quarter, random.uniform(), random.uniform()));
    const Passage passage =
        visibility.ray(x, own, shooter, group_factors, shooter_quarter, random, blocker);
    v.tint.add(1.0, passage);
    if (passage.share > 0.0) dimmed2 += (1.0 - passage.share) * (1.0 - passage.share);
    return passage.share;
  }
  /// Standard deviation of the mean of 16 rays by what panes pass of the open ones.
  double deviation_by_panes(double mean, int open) const {
    const double kept = open > 0 ? 1.0 - 16.0 * mean / open : 0.0;
    return std::sqrt(std::max(0.0, dimmed2 / 16.0 - open / 16.0 * kept * kept) / 16.0);
  }
  PairVisibility one() {
    PairVisibility v;
    v.sampled = true;
    const int quarter = static_cast<int>(random.below(4));
    v.fill(ray(quarter, quarter, nullptr, v));
    v.uncertainty = one_ray_uncertainty;
    return v;
  }
  /// One ray from each quarter; returns how many are open.
  int four(PairVisibility& v, std::uint32_t& blocker) {
    int count = 0;
    for (int q = 0; q < 4; ++q) {
      const double share = ray(q, first_partner(q), &blocker, v);
      v.at[static_cast<std::size_t>(q)] = share;
      count += share > 0.0 ? 1 : 0;
    }
    return count;
  }
  /// Twelve more than four(), so that each pair of quarters has one ray; returns how many of the 16
  /// are open.
  int sixteen(PairVisibility& v, int open_of_four) {
    int count = open_of_four;
    for (int q = 0; q < 4; ++q) {
      for (int other = 0; other < 4; ++other) {
        if (other == first_partner(q)) continue;
        const double share = ray(q, other, nullptr, v);
        v.at[static_cast<std::size_t>(q)] += share;
        count += share > 0.0 ? 1 : 0;
      }
      v.at[static_cast<std::size_t>(q)] /= 4.0;
    }
    return count;
  }
};

LinkVisibility::Target LinkVisibility::target_on(const LinkSide& shooter,
                                                 std::span<const double> group_factors, int quarter,
                                                 Random& random) const {
  if (shooter.is_patch()) {
    const Vec3 y = shooter.frame().at(
        shooter.shape.point_in_quarter(quarter, random.uniform(), random.uniform()));
    return {y, occluders_->global(shooter.cluster, shooter.id.root)};
  }
  if (!shooter.is_group()) {
    if (shooter.part->is_point()) return {shooter.center, RayScene::no_polygon};
    return {shooter.part->point_in_quarter(quarter, random.uniform(), random.uniform()),
            RayScene::no_polygon};
  }
  // A polygon by its share of the group's factor, stratified over the quarters, then a point on it.
  const GroupNode& group = shooter.group();
  double total = 0.0;
  for (const double w : group_factors) total += w;
  double pick = total * (quarter + random.uniform()) / 4.0;
  std::uint32_t i = 0;
  while (i + 1 < group_factors.size() && pick >= group_factors[i]) pick -= group_factors[i++];
  const std::uint32_t k = shooter.forest->order()[group.begin + i];
  const int q = static_cast<int>(random.below(4));
  const Vec3 y = shooter.forest->frames()[k].at(
      shooter.forest->node(k).shape.point_in_quarter(q, random.uniform(), random.uniform()));
  return {y, occluders_->global(shooter.cluster, k)};
}

Passage LinkVisibility::ray(const Vec3& x, std::uint32_t skip, const LinkSide& shooter,
                            std::span<const double> group_factors, int quarter, Random& random,
                            std::uint32_t* blocker) {
  const auto [y, skip_shooter] = target_on(shooter, group_factors, quarter, random);
  ++work_->rays;
  if (blocker == nullptr) return occluders_->passage(x, y, skip, skip_shooter);
  const double distance = glm::length(y - x);
  const RayHit hit =
      occluders_->rays().closest(x, y - x, skip, distance - occluders_->rays().epsilon_m());
  if (!hit.any() || hit.polygon == skip_shooter)
    return occluders_->dimmed(x, y - x, distance - occluders_->rays().epsilon_m(), skip);
  *blocker = hit.polygon;
  return {0.0, {}};
}

/// After four rays that agree: true where a proof shows that all is open, or that `blocker` hides
/// all.
bool LinkVisibility::proven(const LinkSide& receiver, const LinkSide& shooter, bool open,
                            std::uint32_t blocker) {
  ++work_->shafts;
  if (!open) return occluders_->shaft_shut(receiver.corners, shooter.corners, blocker);
  // The exact method has tried the shaft between two patches already.
  return shooter.is_light() && one_flat_side(shooter) &&
         occluders_->shaft_open(receiver.corners, shooter.corners,
                                occluders_->global(receiver.cluster, receiver.id.root),
                                RayScene::no_polygon);
}

/// Where nothing but whole panes stands between: what passes to the receiver's four points, exact
/// of each of the light's points.
bool LinkVisibility::through_whole_panes(const LinkSide& receiver, const LinkSide& light,
                                         PairVisibility& v) {
  const std::uint32_t own = occluders_->global(receiver.cluster, receiver.id.root);
  if (!light.is_light() || !one_flat_side(light) ||
      !only_whole_panes_between(receiver.corners, own, light.corners, *occluders_))
    return false;
  const PolygonFrame& frame = receiver.frame();
  const auto points = receiver.shape.quadrature();
  v.tint = {};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 x = frame.at(points[k]);
    double all = 0.0, passed = 0.0;
    for (const LightPoint& point : light.part->points()) {
      const double one = point.share * kernel_from(*light.part->light, point.y, x, frame.n);
      const Passage passage = occluders_->passage(x, point.y, own, RayScene::no_polygon);
      v.tint.add(one, passage);
      all += one;
      passed += one * passage.share;
    }
    if (all > 0.0) v.at[k] = passed / all;
  }
  v.center = mean_of(v.at);
  return true;
}

/// One, four or sixteen rays, by the power at stake.
PairVisibility LinkVisibility::by_rays(const LinkSide& receiver, const LinkSide& shooter,
                                       std::span<const double> group_factors, double power,
                                       double tolerance) {
  QuarterRays rays{*this,
                   receiver,
                   shooter,
                   group_factors,
                   occluders_->global(receiver.cluster, receiver.id.root),
                   Random(LinkSide::seed_of(receiver, shooter) + draw_)};
  if (power <= one_ray_share * tolerance) return rays.one();
  PairVisibility v;
  std::uint32_t blocker = RayScene::no_polygon;
  const int open_of_four = rays.four(v, blocker);
  const bool agree = open_of_four == 0 || open_of_four == 4;
  if (four_rays_uncertainty * power <= tolerance) {
    v.sampled = true;
    v.fill(mean_of(v.at));
    v.uncertainty = agree ? agreeing_uncertainty : four_rays_uncertainty;
    return v;
  }
  if (agree && !shooter.is_group() && method_ == VisibilityMethod::exact) {
    v.center = mean_of(v.at);
    if (open_of_four == 4 && through_whole_panes(receiver, shooter, v)) return v;
    if (proven(receiver, shooter, open_of_four == 4, blocker)) return v;
  }
  const int open = rays.sixteen(v, open_of_four);
  v.sampled = true;
  v.center = mean_of(v.at);
  v.uncertainty = std::hypot(uncertainty_of_16(open), rays.deviation_by_panes(v.center, open));
  return v;
}

/// Between the parts of two patches that face each other: rays to a part behind the other patch's
/// plane carry no light, or come through the back of the receiver's own polygon.
PairVisibility LinkVisibility::of(const LinkSide& receiver, const LinkSide& shooter,
                                  std::span<const double> group_factors, double power,
                                  double tolerance) {
  if (!shooter.is_patch()) return by_rays(receiver, shooter, group_factors, power, tolerance);
  const Plane receives = receiver.plane(), shoots = shooter.plane();
  const double slack_m = 1e-9 * (receiver.radius + shooter.radius);  // rounding
  const auto straddles = [&](const Polygon& corners, const Plane& plane) {
    return std::any_of(corners.begin(), corners.end(),
                       [&](const Vec3& p) { return plane.signed_distance(p) < -slack_m; });
  };
  const LinkSide* to = &receiver;
  const LinkSide* from = &shooter;
  LinkSide facing_receiver, facing_shooter;
  if (straddles(receiver.corners, shoots)) {
    facing_receiver = receiver.before(shoots);
    to = &facing_receiver;
  }
  if (straddles(shooter.corners, receives)) {
    facing_shooter = shooter.before(receives);
    from = &facing_shooter;
  }
  if (four_rays_uncertainty * power > tolerance && method_ == VisibilityMethod::exact &&
      find_between(*to, *from) && between_.size() <= most_occluders) {
    PairVisibility v;
    if (between_.empty() && panes_.empty()) return v;
    if (one_hides_all(*to, *from)) {
      v.fill(0.0);
      return v;
    }
    if (const auto exact = by_parts(receiver, shooter)) return *exact;
  }
  return by_rays(*to, *from, group_factors, power, tolerance);
}

LinkVisibility::Between LinkVisibility::between() const {
  return all_between_ ? std::make_shared<const std::vector<std::uint32_t>>(between_) : nullptr;
}

/// Lists the polygons between two patches in between_; false where there are more than most_listed.
bool LinkVisibility::find_between(const LinkSide& receiver, const LinkSide& shooter) {
  ++work_->shafts;
  const std::uint32_t own = occluders_->global(receiver.cluster, receiver.id.root);
  const std::uint32_t other = occluders_->global(shooter.cluster, shooter.id.root);
  occluders_->panes_between(receiver.corners, shooter.corners, own, other, panes_);
  if (among_) {
    occluders_->find_among(*among_, receiver.corners, shooter.corners, own, other, between_);
    all_between_ = true;
  } else {
    all_between_ = occluders_->find_between(receiver.corners, shooter.corners, own, other,
                                            most_listed, between_);
  }
  return all_between_;
}

bool LinkVisibility::one_hides_all(const LinkSide& receiver, const LinkSide& shooter) const {
  return std::any_of(between_.begin(), between_.end(), [&](std::uint32_t occluder) {
    return occluders_->shaft_shut(receiver.corners, shooter.corners, occluder);
  });
}

}  // namespace enfilade
