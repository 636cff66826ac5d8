#include "links/link_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/form_factor.hpp"

namespace enfilade {
namespace {

/// More than any power: the sides touch, and distance bounds nothing.
constexpr double unbounded = 1e300;
/// Share of a far node's mean radiosity that it sends in any direction, for bounds.
constexpr double turned_away_share = 0.1;
/// Share of the bound that a group may receive where no light arrives at its middle.
constexpr double rim_share = 0.05;
// A receiving group's errors and variation, as shares of what it receives: it stands for polygons
// that differ in distance and visibility. Used only where the power is small (LinkRefinement).
constexpr double group_error = 0.3, hidden_group_error = 0.1, group_variation_share = 0.3;

/// Added to the seed of rays that are independent of the first ones: any large odd number.
constexpr std::uint64_t other_draw = 0x9E3779B97F4A7C15ull;

/// All corners on or behind the plane: no light passes between the plane's front and that side.
bool behind(const Polygon& corners, const Vec3& origin, const Vec3& n, double tolerance_m) {
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vec3& p) { return glm::dot(n, p - origin) <= tolerance_m; });
}

/// True where all of the receiver lies behind a light that sends nothing backwards, as the ceiling
/// around a recessed luminaire does: each point of it seen from each point of the opening.
bool behind_beam(const LinkSide& receiver, const LinkSide& shooter, double tolerance_m) {
  const LightSource& light = *shooter.part->light;
  if (!light.distribution || !light.distribution->is_dark_behind()) return false;
  const Vec3& aim = light.frame.aim;
  double lowest = glm::dot(aim, shooter.corners[0]);
  for (const Vec3& corner : shooter.corners) lowest = std::min(lowest, glm::dot(aim, corner));
  if (receiver.is_patch()) return behind(receiver.corners, lowest * aim, aim, tolerance_m);
  return highest_distance(receiver.bounds, {aim, lowest}) <= tolerance_m;
}

double light_bound(const LinkSide& receiver, const LinkSide& shooter, double gap) {
  const double most = shooter.most_toward(receiver);
  if (most <= 0.0) return 0.0;
  return gap > 0.0 ? most * receiver.area_m2 / (gap * gap) : unbounded;
}

}  // namespace

double LinkEstimator::factor_bound(const LinkSide& receiver, const LinkSide& shooter) {
  const double gap =
      std::max(glm::length(receiver.center - shooter.center) - receiver.radius - shooter.radius,
               gap_m(receiver.bounds, shooter.bounds));
  if (shooter.is_light()) return light_bound(receiver, shooter, gap);
  const double factor =
      gap > 0.0 ? std::min(1.0, shooter.area_m2 / (std::numbers::pi * gap * gap)) : 1.0;
  return receiver.area_m2 * factor;
}

double LinkEstimator::power_bound(const LinkSide& receiver, const LinkSide& shooter) {
  if (!shooter.is_far())
    return shooter.light > 0.0 ? shooter.light * factor_bound(receiver, shooter) : 0.0;
  // A far node that sends nothing to the receiver's middle may light its ends.
  const BuildingLight& light = shooter.far->light();
  const std::uint32_t node = shooter.id.group();
  const double all = light.radiosity(node, Vec3(0.0)), brightest = light.brightest(node);
  const double by_distance =
      std::max(shooter.light, turned_away_share * all) * factor_bound(receiver, shooter);
  return brightest > 0.0 ? std::min(by_distance, shooter.portal_m2 * brightest) : by_distance;
}

bool LinkEstimator::faces_away(const LinkSide& receiver, const LinkSide& shooter) {
  const double tolerance_m = 1e-9 * (receiver.radius + shooter.radius);  // rounding
  if (receiver.is_patch()) {
    const PolygonFrame& f = receiver.frame();
    if (shooter.is_patch() || shooter.is_light()) {
      if (behind(shooter.corners, f.origin, f.n, tolerance_m)) return true;
    } else if (highest_distance(shooter.bounds, receiver.plane()) <= tolerance_m) {
      return true;
    }
  }
  if (shooter.is_light()) return behind_beam(receiver, shooter, tolerance_m);
  if (shooter.is_patch()) {
    const PolygonFrame& f = shooter.frame();
    if (receiver.is_patch()) return behind(receiver.corners, f.origin, f.n, tolerance_m);
    return highest_distance(receiver.bounds, shooter.plane()) <= tolerance_m;
  }
  return false;
}

void LinkEstimator::clear_group_factors(const LinkSide& shooter) {
  group_factors_.assign(shooter.is_group() ? shooter.group().end - shooter.group().begin : 0, 0.0);
}

/// The form factor from x with normal n to the whole shooter. From a group: the sum over its
/// polygons, each of which is added to `per_polygon` unless that is empty.
double LinkEstimator::factor_at(const Vec3& x, const Vec3& n, const LinkSide& shooter,
                                std::span<double> per_polygon) {
  if (shooter.is_light()) {
    ++work_->kernels;
    return kernel_of(*shooter.part, x, n).at;
  }
  if (shooter.is_patch()) {
    ++work_->form_factors;
    return point_to_polygon(x, n, shooter.corners);
  }
  const GroupNode& group = shooter.group();
  double sum = 0.0;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const std::uint32_t k = shooter.forest->order()[i];
    const PolygonFrame& frame = shooter.forest->frames()[k];
    if (glm::dot(frame.n, x - frame.origin) <= 0.0) continue;
    polygon_.clear();
    for (const Vec2& p : shooter.forest->node(k).shape.vertices) polygon_.push_back(frame.at(p));
    ++work_->form_factors;
    const double f = point_to_polygon(x, n, polygon_);
    if (!per_polygon.empty()) per_polygon[i - group.begin] += f;
    sum += f;
  }
  return sum;
}

LinkEstimate LinkEstimator::evaluate(const LinkSide& receiver, const LinkSide& shooter,
                                     double tolerance, const Between& among) {
  if (shooter.is_far()) return evaluate_far(receiver, shooter, tolerance);
  visibility_.begin(among, draw_);
  return receiver.is_group() ? evaluate_group(receiver, shooter)
                             : evaluate_patch(receiver, shooter, tolerance);
}

LinkEstimate LinkEstimator::kept(const LinkSide& receiver, const LinkSide& shooter,
                                 double tolerance, const Between& among,
                                 const LinkEstimate& decided) {
  if (!decided.sampled) return decided;
  draw_ = other_draw;
  LinkEstimate anew = evaluate(receiver, shooter, tolerance, among);
  draw_ = 0;
  return anew;
}

/// The share of a shooter that a receiving group sees, by four rays from points on its polygons,
/// which are drawn by their area facing the shooter (`facing`, `facing_m2` in all).
double LinkEstimator::seen_by_group(const LinkSide& receiver, const LinkSide& shooter,
                                    std::span<const double> facing, double facing_m2,
                                    TintSum& tint) {
  const GroupNode& group = receiver.group();
  Random random(LinkSide::seed_of(receiver, shooter) + draw_);
  double open = 0.0;
  for (int ray = 0; ray < 4; ++ray) {
    double pick = facing_m2 * (ray + random.uniform()) / 4.0;
    std::uint32_t i = 0;
    while (i + 1 < facing.size() && pick >= facing[i]) pick -= facing[i++];
    const std::uint32_t k = receiver.forest->order()[group.begin + i];
    const PolygonFrame& frame = receiver.forest->frames()[k];
    const Vec3 x = frame.at(receiver.forest->node(k).shape.point_in_quarter(
        static_cast<int>(random.below(4)), random.uniform(), random.uniform()));
    const std::uint32_t own = occluders_->global(receiver.cluster, k);
    const Passage passage = visibility_.ray(x, own, shooter, group_factors_, ray, random, nullptr);
    tint.add(1.0, passage);
    open += passage.share;
  }
  return open / 4.0;
}

/// A far group receives as one: the irradiance of a plane that faces the shooter, and the direction
/// to the shooter.
LinkEstimate LinkEstimator::evaluate_group(const LinkSide& receiver, const LinkSide& shooter) {
  LinkEstimate out;
  const Vec3 d = shooter.center - receiver.center;
  const double distance = glm::length(d);
  const Vec3 toward = distance > 0.0 ? d / distance : Vec3(0.0, 0.0, 1.0);
  clear_group_factors(shooter);
  const double factor = factor_at(receiver.center, toward, shooter, group_factors_);
  const GroupNode& group = receiver.group();
  double facing_m2 = 0.0;
  std::vector<double> facing;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const std::uint32_t k = receiver.forest->order()[i];
    const double cosine = std::max(0.0, glm::dot(receiver.forest->frames()[k].n, toward));
    facing.push_back(cosine * receiver.forest->node(k).shape.area_m2);
    facing_m2 += facing.back();
  }
  if (factor <= 0.0 || facing_m2 <= 0.0) {
    out.receiver_error = rim_share * factor_bound(receiver, shooter);
    return out;
  }
  out.sampled = true;
  TintSum tint;
  const double seen = seen_by_group(receiver, shooter, facing, facing_m2, tint);
  out.tint = tint.mean();
  out.transport = {static_cast<float>(factor * seen), static_cast<float>(toward.x),
                   static_cast<float>(toward.y), static_cast<float>(toward.z)};
  out.receiver_error = facing_m2 * factor * (seen == 0.0 ? hidden_group_error : group_error);
  out.variation = facing_m2 * factor * seen * group_variation_share;
  return out;
}

}  // namespace enfilade
