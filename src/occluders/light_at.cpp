#include "occluders/light_at.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "occluders/sky_at.hpp"

namespace enfilade {
namespace {

/// Parts are halved while their estimated error is above this share of the light.
constexpr double least_error = 5e-5;
/// A part whose points all shine past the place is halved while it may bring more than this share.
constexpr double least_unseen = 2e-3;
/// Parts with a shadow's edge are halved while they bring more than this share.
constexpr double least_shadow = 2e-3;
/// A part is halved while its radius is more than this share of the distance: its points and its
/// middle may agree by chance.
constexpr double near_share = 0.25;
constexpr int most_part_halvings = 14;
/// An opening is looked at in two parts, or four, where its radius is this share of the distance:
/// so that an edge of a shadow is noticed.
constexpr double wide = 0.1, very_wide = 0.3;
/// Of the light of a part of which some points are hidden: the error that remains.
constexpr double mixed_error = 0.25;
/// What passes from two points differs by more than this where they are seen through other panes.
constexpr double other_pane = 0.05;
using std::numbers::pi;

/// Of what passes from several points.
struct Range {
  double least = 1.0, most = 0.0;
  void add(double share) {
    least = std::min(least, share);
    most = std::max(most, share);
  }
};

class Opening {
 public:
  Opening(const LitPlace& place, const Occluders& occluders, WorkCount* work)
      : place_(place), occluders_(occluders), work_(work) {}

  LightAtPoint of(const LightSource& light) {
    const LightPart whole = LightPart::whole(light);
    if (behind(light, whole)) return {};
    const LightKernel kernel = kernel_of(whole, place_.x, place_.n);
    scale_ = std::max(kernel.at, kernel.spread);
    const double distance = glm::length(whole.center - place_.x);
    least_halvings_ = whole.is_point() || whole.radius <= wide * distance ? 0
                      : whole.radius <= very_wide * distance              ? 1
                                                                          : 2;
    add(whole, kernel, 0);
    // Where some see the place and some do not, the edge may run between parts that agree in
    // themselves: their corners are asked as well.
    if (any_seen_ && (any_hidden_ || any_dimmed_) && !whole.is_point()) {
      with_corners_ = true;
      sum_ = error2_ = edge_error_ = 0.0;
      tint_ = {};
      add(whole, kernel, 0);
    }
    return {sum_, std::sqrt(error2_) + edge_error_, tint_.mean()};
  }

 private:
  Passage passage(const Vec3& y) const {
    if (work_ != nullptr) ++work_->rays;
    return occluders_.passage(place_.x, y, place_.own, RayScene::no_polygon, place_.start);
  }

  /// True where the place is behind a light that sends nothing backwards.
  bool behind(const LightSource& light, const LightPart& whole) const {
    if (!light.distribution || !light.distribution->is_dark_behind()) return false;
    const Vec3& aim = light.frame.aim;
    const Polygon corners = whole.corners();
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Vec3& y) { return glm::dot(aim, place_.x - y) <= 0.0; });
  }

  /// True where a beam from between the part's points may meet the place.
  bool may_shine(const LightPart& part) const {
    const Vec3 d = place_.x - part.center;
    const double distance = glm::length(d);
    if (glm::dot(part.center - place_.x, place_.n) <= -part.radius) return false;  // below it
    ViewCone cone{Vec3(0.0, 0.0, 1.0), pi};
    if (distance > part.radius) cone = {d / distance, std::asin(part.radius / distance)};
    const double nearest = std::max(distance - part.radius, 0.5 * part.radius);
    const double most =
        part.share * most_relative_intensity(*part.light, cone) / (nearest * nearest);
    return most > least_unseen * std::max(scale_, 1.0 / (distance * distance));
  }

  /// True where a corner of a part of one polygon is seen and the points are not, or the reverse,
  /// or is seen through other panes.
  bool corners_differ(const LightPart& part, const Range& passed) const {
    if (!part.is_one_polygon()) return false;
    const Polygon corners = part.corners();
    return std::any_of(corners.begin(), corners.end(), [&](const Vec3& y) {
      if (glm::dot(y - place_.x, place_.n) <= 0.0) return false;
      const double share = passage(y).share;
      return (share > 0.0) != (passed.most > 0.0) || share > passed.most + other_pane ||
             share < passed.least - other_pane;
    });
  }

  void add(const LightPart& part, const LightKernel& kernel, int halvings) {
    const bool may_halve = !part.is_point() && halvings < most_part_halvings;
    const bool rough = kernel.spread > least_error * scale_ ||
                       (may_halve && kernel.at <= 0.0 && kernel.spread <= 0.0 && may_shine(part));
    const bool matters = kernel.at > least_shadow * scale_;
    const bool near = part.radius > near_share * glm::length(part.center - place_.x) &&
                      kernel.at > least_error * scale_;
    if (may_halve && (rough || near || halvings < least_halvings_)) {
      halve(part, halvings);
      return;
    }
    double sum = 0.0;
    int seen = 0, count = 0;
    Range passed;
    TintSum tint;
    for (const LightPoint& point : part.points()) {
      const double one = point.share * kernel_from(*part.light, point.y, place_.x, place_.n);
      if (one <= 0.0) continue;
      ++count;
      const Passage passing = passage(point.y);
      passed.add(passing.share);
      tint.add(one, passing);
      if (passing.share <= 0.0) continue;
      ++seen;
      sum += one * passing.share;
    }
    any_seen_ |= seen > 0;
    any_hidden_ |= seen < count;
    any_dimmed_ |= passed.least < 1.0 && passed.most > 0.0;
    const bool mixed = (seen > 0 && seen < count) || passed.most - passed.least > other_pane ||
                       (with_corners_ && matters && corners_differ(part, passed));
    if (mixed && may_halve && matters) {
      halve(part, halvings);
      return;
    }
    sum_ += sum;
    tint_.add(tint);
    error2_ += kernel.spread * kernel.spread;
    if (mixed) edge_error_ += mixed_error * kernel.at;
  }

  void halve(const LightPart& part, int halvings) {
    for (const int side : {0, 1}) {
      const LightPart half = part.half(side);
      const LightKernel kernel = kernel_of(half, place_.x, place_.n);
      scale_ = std::max(scale_, kernel.at);
      add(half, kernel, halvings + 1);
    }
  }

  const LitPlace& place_;
  const Occluders& occluders_;
  WorkCount* work_;
  double scale_ = 0.0;  ///< about the whole light that may arrive
  int least_halvings_ = 0;
  bool any_seen_ = false, any_hidden_ = false, any_dimmed_ = false, with_corners_ = false;
  TintSum tint_;
  double sum_ = 0.0, error2_ = 0.0;
  double edge_error_ = 0.0;  ///< parts on one edge err alike: a plain sum
};

}  // namespace

LightAtPoint light_at(const LightSource& light, const LitPlace& place, const Occluders& occluders,
                      WorkCount* work) {
  if (light.sky) return sky_at(light, place, occluders, work);
  return Opening(place, occluders, work).of(light);
}

LightAtPoint light_by_one_ray(const LightSource& light, const LitPlace& place,
                              const Occluders& occluders, double r1, double r2) {
  const Vec3 y = point_on(light, r1, r2);
  const double kernel = kernel_from(light, y, place.x, place.n);
  if (kernel <= 0.0) return {};
  Passage passage = occluders.passage(place.x, y, place.own, RayScene::no_polygon, place.start);
  return {kernel * passage.share, 0.0, std::move(passage.tint)};
}

}  // namespace enfilade
