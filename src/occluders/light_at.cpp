#include "occluders/light_at.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/visible_parts.hpp"
#include "occluders/pane_view.hpp"
#include "occluders/sky_at.hpp"

namespace enfilade {
namespace {

/// Parts are halved while their estimated error is above this share of the light.
constexpr double least_error = 5e-5;
/// A part whose points all shine past the place is halved while it may bring more than this share.
constexpr double least_unseen = 2e-3;
/// Parts behind too many occluders are halved while they bring more than this share.
constexpr double least_shadow = 2e-3;
/// A part is halved while its radius is more than this share of the distance: its points and its
/// middle may agree by chance.
constexpr double near_share = 0.25;
constexpr int most_part_halvings = 14;
/// Up to so many occluders, and panes, are cut out of a part exactly.
constexpr std::size_t most_shadows = 16;
/// More polygons than these are looked for anew before each half.
constexpr std::size_t most_kept = 4096;
/// Of the light of a part of which rays find some points hidden: the error that remains.
constexpr double mixed_error = 0.25;
/// What passes from two points differs by more than this where they are seen through other panes.
constexpr double other_pane = 0.05;
using std::numbers::pi;

class Opening {
 public:
  Opening(const LitPlace& place, const Occluders& occluders, WorkCount* work)
      : place_(place), occluders_(occluders), work_(work) {}

  LightAtPoint of(const LightSource& light) {
    const LightPart whole = LightPart::whole(light);
    if (behind(light, whole)) return {};
    const LightKernel kernel = kernel_of(whole, place_.x, place_.n);
    scale_ = std::max(kernel.at, kernel.spread);
    add(whole, kernel, 0, nullptr);
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

  /// `among`: polygons of which those before the part are some; null where they are not known.
  void add(const LightPart& part, const LightKernel& kernel, int halvings,
           const std::vector<std::uint32_t>* among) {
    if (part.is_point()) {
      add_by_rays(part, kernel);
      return;
    }
    if (!part.is_one_polygon()) {
      halve(part, halvings, among);
      return;
    }
    if (kernel.at <= 0.0 && kernel.spread <= 0.0 && !may_shine(part)) return;
    const Polygon outline = facing(part.corners());
    std::vector<std::uint32_t> between;
    const bool known = find_between(outline, among, between);
    const std::vector<std::uint32_t>* next = known ? &between : nullptr;
    if (known && !between.empty() && hidden_by_one(outline)) return;
    const bool may_halve = halvings < most_part_halvings;
    const bool rough = kernel.spread > least_error * scale_ ||
                       (may_halve && kernel.at <= 0.0 && kernel.spread <= 0.0);
    const bool near = part.radius > near_share * glm::length(part.center - place_.x) &&
                      kernel.at > least_error * scale_;
    if (may_halve && (rough || near)) {
      halve(part, halvings, next);
    } else if (known && add_visible(part, kernel, outline, between)) {
      error2_ += kernel.spread * kernel.spread;
    } else if (may_halve && kernel.at > least_shadow * scale_) {
      halve(part, halvings, next);
    } else {
      add_by_rays(part, kernel);
    }
  }

  /// The polygon, turned to show its front to the place.
  Polygon facing(Polygon polygon) const {
    if (glm::dot(area_vector(polygon), place_.x - polygon[0]) < 0.0)
      std::reverse(polygon.begin(), polygon.end());
    return polygon;
  }

  bool find_between(const Polygon& outline, const std::vector<std::uint32_t>* among,
                    std::vector<std::uint32_t>& between) const {
    constexpr std::uint32_t none = RayScene::no_polygon;
    if (work_ != nullptr) ++work_->shafts;
    if (among == nullptr) {
      return occluders_.find_between({place_.x}, outline, place_.own, none, most_kept, between);
    }
    if (!among->empty())
      occluders_.find_among(*among, {place_.x}, outline, place_.own, none, between);
    return true;
  }

  /// True where the rays to all corners end on one polygon, which is convex and hides all then.
  bool hidden_by_one(const Polygon& outline) const {
    std::uint32_t wall = RayScene::no_polygon;
    for (const Vec3& corner : outline) {
      const Vec3 d = corner - place_.x;
      const double length_m = glm::length(d) - 2.0 * occluders_.rays().epsilon_m();
      if (work_ != nullptr) ++work_->rays;
      const RayHit hit = occluders_.rays().closest(place_.x, d, place_.own, length_m, place_.start);
      if (!hit.any() || (wall != RayScene::no_polygon && hit.polygon != wall)) return false;
      wall = hit.polygon;
    }
    return true;
  }

  /// Adds what arrives from what is seen of a part, exactly; false where that is too much work.
  bool add_visible(const LightPart& part, const LightKernel& kernel, const Polygon& outline,
                   const std::vector<std::uint32_t>& between) {
    if (between.empty() && !occluders_.panes().any()) {
      sum_ += kernel.at;
      tint_.add(kernel.at, {});
      return true;
    }
    if (between.size() > most_shadows) return false;
    visible_.begin(place_.x, outline, occluders_.tolerance_m());
    for (const std::uint32_t k : between)
      if (!visible_.hide(occluders_.polygon(k))) return false;
    occluders_.panes_between({place_.x}, outline, place_.own, RayScene::no_polygon, panes_);
    if (panes_.size() > most_shadows) return false;
    const double share_per_m2 = part.share / part.shape.area_m2;
    for (std::size_t i = 0; i < visible_.size(); ++i) {
      if (panes_.empty()) {
        add_piece(*part.light, share_per_m2, visible_[i], {});
        continue;
      }
      cut_by_panes(place_.x, place_.n, visible_[i], panes_, occluders_, dimmed_);
      for (const DimmedPart& piece : dimmed_)
        add_piece(*part.light, share_per_m2, piece.polygon, piece.passage);
    }
    return true;
  }

  /// A convex piece, small enough for three points of each triangle.
  void add_piece(const LightSource& light, double share_per_m2, std::span<const Vec3> piece,
                 const Passage& passing) {
    double sum = 0.0;
    for (std::size_t i = 2; i < piece.size(); ++i) {
      const Vec3 corner[3] = {piece[0], piece[i - 1], piece[i]};
      const double area_m2 =
          0.5 * glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
      for (int side = 0; side < 3; ++side) {
        const Vec3 y = 0.5 * (corner[side] + corner[(side + 1) % 3]);
        sum += area_m2 / 3.0 * kernel_from(light, y, place_.x, place_.n);
      }
    }
    sum_ += share_per_m2 * sum * passing.share;
    tint_.add(share_per_m2 * sum, passing);
  }

  void add_by_rays(const LightPart& part, const LightKernel& kernel) {
    int seen = 0, count = 0;
    double least = 1.0, most = 0.0;  // of what passes
    for (const LightPoint& point : part.points()) {
      const double one = point.share * kernel_from(*part.light, point.y, place_.x, place_.n);
      if (one <= 0.0) continue;
      ++count;
      const Passage passing = passage(point.y);
      tint_.add(one, passing);
      seen += passing.share > 0.0;
      least = std::min(least, passing.share);
      most = std::max(most, passing.share);
      sum_ += one * passing.share;
    }
    error2_ += kernel.spread * kernel.spread;
    if ((seen > 0 && seen < count) || most > least + other_pane)
      edge_error_ += mixed_error * kernel.at;
  }

  void halve(const LightPart& part, int halvings, const std::vector<std::uint32_t>* among) {
    for (const int side : {0, 1}) {
      const LightPart half = part.half(side);
      const LightKernel kernel = kernel_of(half, place_.x, place_.n);
      scale_ = std::max(scale_, kernel.at);
      add(half, kernel, halvings + 1, among);
    }
  }

  const LitPlace& place_;
  const Occluders& occluders_;
  WorkCount* work_;
  double scale_ = 0.0;  ///< about the whole light that may arrive
  TintSum tint_;
  double sum_ = 0.0, error2_ = 0.0;
  double edge_error_ = 0.0;  ///< parts on one edge err alike: a plain sum
  VisibleParts visible_;
  std::vector<std::uint32_t> panes_;
  std::vector<DimmedPart> dimmed_;
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
