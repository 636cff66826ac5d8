#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "geometry/form_factor.hpp"
#include "links/link_estimate.hpp"

namespace enfilade {
namespace {

/// More occluders than that are seen to by rays: cutting costs their number times the parts, rays
/// do not.
constexpr std::size_t most_occluders = 16;
/// Up to so many are kept for a link's parts to be held against, instead of all polygons.
constexpr std::size_t most_listed = 32;

/// Where on its plane the light of these parts comes from, as x with normal n weighs it: three
/// points a triangle, exact for quadratics (Strang and Fix).
Vec2 mean_place(const VisibleParts& parts, const Vec3& x, const Vec3& n,
                const PolygonFrame& frame) {
  Vec2 sum(0.0);
  double weight = 0.0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::span<const Vec3> part = parts[p];
    for (std::size_t i = 2; i < part.size(); ++i) {
      const Vec3 corner[3] = {part[0], part[i - 1], part[i]};
      const double area = glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
      for (int side = 0; side < 3; ++side) {
        const Vec3 y = 0.5 * (corner[side] + corner[(side + 1) % 3]);
        const double w = area * point_kernel(x, n, y, frame.n);
        weight += w;
        sum += w * frame.project(y);
      }
    }
  }
  return weight > 0.0 ? sum / weight : Vec2(0.0);
}

}  // namespace

bool LinkEstimator::ray_open(const Vec3& x, std::uint32_t skip, const LinkSide& shooter,
                             int quarter, Random& random, std::uint32_t* blocker) {
  Vec3 y = shooter.center;
  std::uint32_t skip_shooter = RayScene::no_polygon;
  if (shooter.is_patch()) {
    y = shooter.frame().at(
        shooter.shape.point_in_quarter(quarter, random.uniform(), random.uniform()));
    skip_shooter = occluders_->global(shooter.cluster, shooter.id.root);
  } else if (shooter.is_group()) {
    // A polygon by its share of the group's factor, stratified over the quarters, then a point on
    // it.
    const GroupNode& group = shooter.group();
    double total = 0.0;
    for (const double w : weights_) total += w;
    double pick = total * (quarter + random.uniform()) / 4.0;
    std::uint32_t i = 0;
    while (i + 1 < weights_.size() && pick >= weights_[i]) pick -= weights_[i++];
    const std::uint32_t k = shooter.forest->order()[group.begin + i];
    const int q = static_cast<int>(random.below(4));
    y = shooter.forest->frames()[k].at(
        shooter.forest->node(k).shape.point_in_quarter(q, random.uniform(), random.uniform()));
    skip_shooter = occluders_->global(shooter.cluster, k);
  }
  ++work_->rays;
  if (blocker == nullptr) return !occluders_->rays().occluded(x, y, skip, skip_shooter);
  const double distance = glm::length(y - x);
  const RayHit hit =
      occluders_->rays().closest(x, y - x, skip, distance - occluders_->rays().epsilon_m());
  if (!hit.any() || hit.polygon == skip_shooter) return true;
  *blocker = hit.polygon;
  return false;
}

LinkEstimator::Visibility LinkEstimator::by_rays(const LinkSide& receiver, const LinkSide& shooter,
                                                 double power, double tolerance) {
  Visibility v;
  Random random(LinkSide::seed_of(receiver, shooter));
  const std::uint32_t skip = occluders_->global(receiver.cluster, receiver.id.root);
  const PolygonFrame& frame = receiver.frame();
  auto point = [&](int q) {
    return frame.at(receiver.shape.point_in_quarter(q, random.uniform(), random.uniform()));
  };
  // Too little power for its visibility to matter: one ray.
  if (power <= 0.1 * tolerance) {
    const int q = static_cast<int>(random.below(4));
    const bool open = ray_open(point(q), skip, shooter, q, random, nullptr);
    v.fill(open ? 1.0 : 0.0);
    v.within = 0.5;
    return v;
  }
  int open = 0;
  std::uint32_t blocker = RayScene::no_polygon;
  for (int q = 0; q < 4; ++q) {
    const bool seen = ray_open(point(q), skip, shooter, (q * 3 + 1) % 4, random, &blocker);
    v.at[static_cast<std::size_t>(q)] = seen ? 1.0 : 0.0;
    open += seen ? 1 : 0;
  }
  const bool unanimous = open == 0 || open == 4;
  if (0.25 * power <= tolerance) {
    const double share = open / 4.0;
    v.fill(share);
    v.within = unanimous ? 0.1 : 0.25;
    return v;
  }
  if (unanimous && !shooter.is_group() && method_ == VisibilityMethod::exact) {
    ++work_->shafts;
    const std::uint32_t skip_shooter = shooter.is_light()
                                           ? RayScene::no_polygon
                                           : occluders_->global(shooter.cluster, shooter.id.root);
    const bool certain =
        open == 4 ? shooter.is_light() && occluders_->shaft_open(receiver.corners, shooter.corners,
                                                                 skip, skip_shooter)
                  : occluders_->shaft_shut(receiver.corners, shooter.corners, blocker);
    v.center = open / 4.0;
    if (certain) return v;
  }
  // Twelve more: all pairs of quarters once.
  for (int q = 0; q < 4; ++q) {
    for (int other = 0; other < 4; ++other) {
      if (other == (q * 3 + 1) % 4) continue;
      const bool seen = ray_open(point(q), skip, shooter, other, random, nullptr);
      v.at[static_cast<std::size_t>(q)] += seen ? 1.0 : 0.0;
      open += seen ? 1 : 0;
    }
    v.at[static_cast<std::size_t>(q)] /= 4.0;
  }
  v.center = open / 16.0;
  // Laplace's rule of succession for a proportion seen in 16 trials.
  const double p = (open + 0.5) / 17.0;
  v.within = open == 0 || open == 16 ? p < 0.5 ? p : 1.0 - p : std::sqrt(p * (1.0 - p) / 16.0);
  return v;
}

/// Between the parts of two sides that face each other: a ray to the part that lies behind the
/// other's plane would say nothing, or come through the receiver's own back.
LinkEstimator::Visibility LinkEstimator::visibility(const LinkSide& receiver,
                                                    const LinkSide& shooter, double power,
                                                    double tolerance) {
  if (!shooter.is_patch()) return by_rays(receiver, shooter, power, tolerance);
  const Plane receives = receiver.plane(), shoots = shooter.plane();
  const double slack_m = 1e-9 * (receiver.radius + shooter.radius);
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
  if (0.25 * power > tolerance && method_ == VisibilityMethod::exact) {
    if (find_between(*to, *from) && between_.size() <= most_occluders) {
      Visibility v;
      if (between_.empty()) return v;
      for (const std::uint32_t occluder : between_) {
        if (!occluders_->shaft_shut(to->corners, from->corners, occluder)) continue;
        v.fill(0.0);
        return v;
      }
      if (by_parts(receiver, shooter, v)) return v;
    }
  }
  return by_rays(*to, *from, power, tolerance);
}

LinkEstimator::Between LinkEstimator::between() const {
  return all_between_ ? std::make_shared<const std::vector<std::uint32_t>>(between_) : nullptr;
}

bool LinkEstimator::find_between(const LinkSide& receiver, const LinkSide& shooter) {
  ++work_->shafts;
  const std::uint32_t own = occluders_->global(receiver.cluster, receiver.id.root);
  const std::uint32_t other = occluders_->global(shooter.cluster, shooter.id.root);
  if (among_) {
    occluders_->find_among(*among_, receiver.corners, shooter.corners, own, other, between_);
    all_between_ = true;
  } else {
    all_between_ = occluders_->find_between(receiver.corners, shooter.corners, own, other,
                                            most_listed, between_);
  }
  return all_between_;
}

/// Leaves in parts_ what x sees of the shooter past all that stands between; false where that is
/// too many parts.
bool LinkEstimator::cut_parts(const Vec3& x, const LinkSide& shooter) {
  ++work_->form_factors;
  parts_.begin(x, shooter.corners, occluders_->tolerance_m());
  for (const std::uint32_t occluder : between_) {
    if (!parts_.hide(occluders_->polygon(occluder))) return false;
  }
  return true;
}

/// Exactly at the receiver's points, its centre and its corners; what the corners see otherwise
/// than the points foretell is its error.
bool LinkEstimator::by_parts(const LinkSide& receiver, const LinkSide& shooter, Visibility& v) {
  const PolygonFrame& frame = receiver.frame();
  const PatchShape& shape = receiver.shape;
  const std::array<Vec2, 4> points = shape.quadrature();
  double any_hidden = 0.0, any_seen = 0.0;
  // Returns the factor that is hidden from x; `seen` is the rest.
  const auto look = [&](const Vec3& x, double& seen) {
    const double whole = point_to_polygon(x, frame.n, shooter.corners);
    seen = 0.0;
    if (whole <= 0.0) return 0.0;
    if (!cut_parts(x, shooter)) return -1.0;
    seen = std::min(whole, parts_.factor(frame.n));
    any_seen = std::max(any_seen, seen);
    const double hidden = whole - seen <= 1e-9 * whole ? 0.0 : whole - seen;
    any_hidden = std::max(any_hidden, hidden);
    return hidden;
  };
  std::array<double, 4> hidden{};
  double seen = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 x = frame.at(points[k]);
    hidden[k] = look(x, seen);
    if (hidden[k] < 0.0) return false;
    v.at[k] = hidden[k] > 0.0 ? seen / (seen + hidden[k]) : 1.0;
    if (hidden[k] <= 0.0 || seen <= 0.0) continue;
    v.partial[k] = true;
    v.seen_from[k] = mean_place(parts_, x, frame.n, shooter.frame()) - shooter.shape.centroid;
  }
  const double hidden_center = look(receiver.center, seen);
  if (hidden_center < 0.0) return false;
  v.center = hidden_center > 0.0 ? seen / (seen + hidden_center) : 1.0;

  const double mean = 0.25 * (hidden[0] + hidden[1] + hidden[2] + hidden[3]);
  const double slope1 = 0.25 * (hidden[1] + hidden[3] - hidden[0] - hidden[2]);
  const double slope2 = 0.25 * (hidden[2] + hidden[3] - hidden[0] - hidden[1]);
  const Vec2 e1 = shape.long_axis(), e2{-e1.y, e1.x}, s = shape.deviations();
  double off = 0.0;
  for (const Vec2& vertex : shape.vertices) {
    const Vec2 d = 0.98 * (vertex - shape.centroid);  // a corner's own walls are no occluders
    const double h = look(frame.at(shape.centroid + d), seen);
    if (h < 0.0) return false;
    const double foretold =
        mean + slope1 * glm::dot(d, e1) / s.x + (s.y > 0.0 ? slope2 * glm::dot(d, e2) / s.y : 0.0);
    off += std::abs(h - foretold);
  }
  v.unfit = 0.25 * off / static_cast<double>(shape.vertices.size());
  if (any_hidden <= 0.0) v.unfit = small_shadows(receiver, shooter);
  if (any_seen <= 0.0) v.within = 0.02;
  return true;
}

/// Occluders whose shadows fall between all points: the factor that each hides from the middle of
/// its shadow, by the shadow's share of the receiver.
double LinkEstimator::small_shadows(const LinkSide& receiver, const LinkSide& shooter) {
  const Plane plane = receiver.plane();
  const Vec3& y = shooter.center;
  double sum = 0.0;
  for (const std::uint32_t occluder : between_) {
    const Polygon& polygon = occluders_->polygon(occluder);
    const Vec3 toward = centroid(polygon) - y;
    const double fall = plane.signed_distance(y), step = -glm::dot(plane.n, toward);
    if (fall <= 0.0 || step <= 0.0 || step > fall) continue;
    const double scale = fall / step;
    const Vec3 x = y + scale * toward;
    if (glm::length(x - receiver.center) > receiver.radius) continue;
    const double whole = point_to_polygon(x, plane.n, shooter.corners);
    if (whole <= 0.0 || !cut_parts(x, shooter)) continue;
    const double share = std::min(1.0, area_m2(polygon) * scale * scale / receiver.area_m2);
    sum += std::max(0.0, whole - parts_.factor(plane.n)) * share;
  }
  return sum;
}

}  // namespace enfilade
