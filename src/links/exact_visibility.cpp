// Visibility of a shooting patch by cutting the occluders' shadows out of it, as the receiver's
// points see it.
#include <algorithm>
#include <cmath>

#include "geometry/form_factor.hpp"
#include "links/link_visibility.hpp"
#include "links/terms/four_point_fit.hpp"
#include "links/terms/mean_place.hpp"

namespace enfilade {
namespace {

/// Hidden factors below this share of the whole are rounding errors of the cuts.
constexpr double least_hidden_share = 1e-9;
/// Corners are taken a little inside: a corner's own walls are no occluders.
constexpr double corner_inset = 0.98;
/// Mean absolute misfit of the affine fit over the patch, per misfit at the corners: 0.26 for x^2 +
/// y^2 and 0.25 for x y on a square.
constexpr double corner_misfit_share = 0.25;
/// Where no point sees anything, a point between them may still see this share.
constexpr double all_hidden_uncertainty = 0.02;

}  // namespace

/// Leaves in parts_ what x sees of the shooter past between_; false where that is too many parts.
bool LinkVisibility::cut_parts(const Vec3& x, const LinkSide& shooter) {
  ++work_->form_factors;
  parts_.begin(x, shooter.corners, occluders_->tolerance_m());
  for (const std::uint32_t occluder : between_)
    if (!parts_.hide(occluders_->polygon(occluder))) return false;
  return true;
}

/// Returns the part of the shooter that a point with normal n sees; none where that is too many
/// parts. Raises `most` to the factors of this point.
std::optional<LinkVisibility::PointCut> LinkVisibility::cut_at(const Vec3& x, const Vec3& n,
                                                               const LinkSide& shooter,
                                                               PointCut& most) {
  const double whole = point_to_polygon(x, n, shooter.corners);
  if (whole <= 0.0) return PointCut{};
  if (!cut_parts(x, shooter)) return std::nullopt;
  PointCut cut;
  cut.seen =
      std::min(whole, panes_.empty() ? parts_.factor(n)
                                     : cut_by_panes(x, n, parts_, panes_, *occluders_, dimmed_));
  const double hidden = whole - cut.seen;
  cut.hidden = hidden <= least_hidden_share * whole ? 0.0 : hidden;
  most.seen = std::max(most.seen, cut.seen);
  most.hidden = std::max(most.hidden, cut.hidden);
  return cut;
}

/// Exact at the receiver's four points, its centre and its corners; none where that takes too many
/// parts.
std::optional<PairVisibility> LinkVisibility::by_parts(const LinkSide& receiver,
                                                       const LinkSide& shooter) {
  PairVisibility v;
  const PolygonFrame& frame = receiver.frame();
  const std::array<Vec2, 4> points = receiver.shape.quadrature();
  PointCut most;
  std::array<double, 4> hidden{};
  std::array<TintSum, 4> tints;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 x = frame.at(points[k]);
    const std::optional<PointCut> cut = cut_at(x, frame.n, shooter, most);
    if (!cut) return std::nullopt;
    hidden[k] = cut->hidden;
    v.at[k] = cut->share();
    if (cut->hidden <= 0.0) tints[k].add(cut->seen, {});
    if (cut->hidden <= 0.0 || cut->seen <= 0.0) continue;
    v.partial[k] = true;
    MeanPlace place{x, frame.n, shooter.frame()};
    for (std::size_t p = 0; p < parts_.size() && panes_.empty(); ++p) place.add(parts_[p], 1.0);
    for (std::size_t p = 0; p < dimmed_.size() && !panes_.empty(); ++p) {
      place.add(dimmed_[p].polygon, dimmed_[p].passage.share);
      tints[k].add(dimmed_[p].factor, dimmed_[p].passage);
    }
    v.seen_from[k] = place.mean() - shooter.shape.centroid;
  }
  const std::optional<PointCut> center = cut_at(receiver.center, frame.n, shooter, most);
  if (!center) return std::nullopt;
  v.center = center->share();
  const std::optional<double> misfit = unpredicted_at_corners(receiver, shooter, hidden, most);
  if (!misfit) return std::nullopt;
  v.unfit = most.hidden > 0.0 ? *misfit : small_shadows(receiver, shooter);
  for (const TintSum& tint : tints) v.tint.add(tint);
  v.unfit += v.tint.mean_difference(tints);  // the points' tints count as one
  if (most.seen <= 0.0) v.uncertainty = all_hidden_uncertainty;
  return v;
}

/// Estimates the mean error of the affine fit to the hidden factor, from its misfit at the corners;
/// none where a corner sees too many parts. `hidden`: at the four points.
std::optional<double> LinkVisibility::unpredicted_at_corners(const LinkSide& receiver,
                                                             const LinkSide& shooter,
                                                             const std::array<double, 4>& hidden,
                                                             PointCut& most) {
  const PolygonFrame& frame = receiver.frame();
  const PatchShape& shape = receiver.shape;
  const FourPointFit fit = FourPointFit::of(hidden);
  const Vec2 e1 = shape.long_axis(), e2{-e1.y, e1.x}, s = shape.deviations();
  double off = 0.0;
  for (const Vec2& vertex : shape.vertices) {
    const Vec2 d = corner_inset * (vertex - shape.centroid);
    const std::optional<PointCut> cut =
        cut_at(frame.at(shape.centroid + d), frame.n, shooter, most);
    if (!cut) return std::nullopt;
    const double predicted = fit.mean + fit.slope1 * glm::dot(d, e1) / s.x +
                             (s.y > 0.0 ? fit.slope2 * glm::dot(d, e2) / s.y : 0.0);
    off += std::abs(cut->hidden - predicted);
  }
  return corner_misfit_share * off / static_cast<double>(shape.vertices.size());
}

/// The error from occluders whose shadows fall between all points: the sum of the factors that each
/// hides from the middle of its shadow, times the shadow's share of the receiver's area.
double LinkVisibility::small_shadows(const LinkSide& receiver, const LinkSide& shooter) {
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
