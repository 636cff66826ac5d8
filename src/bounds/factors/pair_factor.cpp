#include "bounds/factors/pair_factor.hpp"

#include <algorithm>
#include <cmath>

#include "bounds/factors/open_factor.hpp"
#include "bounds/factors/pair_sight.hpp"
#include "geometry/clip.hpp"
#include "geometry/form_factor.hpp"

namespace enfilade {
namespace {

double extent_of(const std::vector<Polygon>& polygons) {
  Box box;
  for (const Polygon& polygon : polygons) box.add(bounds(polygon));
  return box.empty() ? 0.0 : box.diagonal();
}

/// Largest standard deviation of a quantity in [k.lo, k.hi] with a mean in `mean` (Bhatia and Davis
/// 2000).
double most_deviation(const Range& k, const Range& mean) {
  const double middle = 0.5 * (k.lo + k.hi);
  const double m =
      std::clamp(middle, std::clamp(mean.lo, k.lo, k.hi), std::clamp(mean.hi, k.lo, k.hi));
  return std::sqrt(std::max(0.0, (k.hi - m) * (m - k.lo)));
}

}  // namespace

/// The parts of receiver and shooter that face each other. The light between them is symmetric, so
/// that the smaller one is the viewer.
struct PairFactors::Pair {
  FlatShape viewer, target;
  std::uint32_t viewer_polygon, target_polygon;
};

PairFactors::PairFactors(std::vector<Polygon> polygons, std::vector<char> panes,
                         const PairFactorConfig& config)
    : config_(config),
      tolerance_m_(1e-7 * extent_of(polygons)),
      panes_(std::move(panes)),
      tree_(std::move(polygons)) {}

PairFactors::Between PairFactors::sorted(std::span<const std::uint32_t> between) const {
  Between found;
  for (const bool panes : {false, true}) {
    for (const std::uint32_t k : between) {
      if (is_pane(k) != panes) continue;
      found.polygons.push_back(&tree_.polygon(k));
      found.panes += panes ? 1 : 0;
    }
  }
  return found;
}

Range PairFactors::occluded_flux(const Pair& pair, const FlatShape& viewer,
                                 std::span<const std::uint32_t> among, double tolerance_m2,
                                 int depth) const {
  std::vector<std::uint32_t> between;
  tree_.find_among(among, shaft_between(viewer.polygon, pair.target.polygon, tolerance_m_),
                   tolerance_m_, pair.viewer_polygon, pair.target_polygon, between);
  if (between.empty())
    return open_flux(viewer, pair.target, 0.25 * tolerance_m2, config_.near_depth);
  const Between walls = sorted(between);
  const SplitSight sight = split_sight(viewer, pair.target.polygon, pair.target.plane,
                                       walls.polygons, tolerance_m_, walls.panes);
  Range flux;
  for (const Polygon& part : sight.seen) {
    const Range f = open_flux(viewer, FlatShape(part, pair.target.plane), 0.3 * tolerance_m2,
                              config_.near_depth);
    flux.lo += f.lo;
    flux.hi += f.hi;
  }
  for (const Polygon& part : sight.unsure) {
    flux.hi += open_flux(viewer, FlatShape(part, pair.target.plane), 0.5 * tolerance_m2,
                         config_.near_depth / 2)
                   .hi;
  }
  if (depth == 0 || flux.width() <= tolerance_m2) return flux;
  const auto [first, second] = halves(viewer);
  const Range a = occluded_flux(pair, first, between, 0.6 * tolerance_m2, depth - 1);
  const Range b = occluded_flux(pair, second, between, 0.6 * tolerance_m2, depth - 1);
  return {std::max(flux.lo, a.lo + b.lo), std::min(flux.hi, a.hi + b.hi)};
}

void PairFactors::bound_points(const FlatShape& receiver, const FlatShape& shooter,
                               const SplitSight* sight, PairFactor& factor) const {
  if (sight == nullptr) {
    factor.at_points = open_point_factor(receiver, shooter, config_.point_parts);
    return;
  }
  Range f;
  for (const Polygon& part : sight->seen) {
    const Range open = open_point_range(receiver, FlatShape(part, shooter.plane), 3);
    f.lo += open.lo;
    f.hi += open.hi;
  }
  for (const Polygon& part : sight->unsure)
    f.hi += open_point_range(receiver, FlatShape(part, shooter.plane), 3).hi;
  f.hi = std::min(f.hi, open_point_range(receiver, shooter, 3).hi);
  f.lo = std::min(f.lo, f.hi);
  factor.at_points = {0.5 * (f.lo + f.hi), Vec3(0.0), 0.5 * f.width()};
}

/// Fills the spreads. `r` and `s` are the parts of receiver and shooter that face each other; where
/// they are not all of them, the kernel is 0 elsewhere.
void PairFactors::bound_spreads(const FlatShape& receiver, const FlatShape& shooter,
                                const FlatShape& r, const FlatShape& s, PairFactor& factor) const {
  const bool whole = r.area_m2 >= receiver.area_m2 * (1.0 - 1e-9);
  Range k = kernel_range(r, s);
  if (!factor.open) k.lo = 0.0;
  if (!whole) {
    k.lo = 0.0;
    const Range f = factor.at_points.range(r.radius_m);
    factor.at_points = {0.5 * std::max(0.0, f.hi), Vec3(0.0), 0.5 * std::max(0.0, f.hi)};
  }
  if (s.area_m2 < shooter.area_m2 * (1.0 - 1e-9)) k.lo = 0.0;
  const double area = shooter.area_m2;
  factor.mean_spread = factor.point_spread = 1e300;
  if (k.hi < 1e299) {
    factor.mean_spread = area * most_deviation(k, {factor.mean.lo / area, factor.mean.hi / area});
    factor.point_spread = 0.5 * area * (k.hi - k.lo);
  }
  if (whole && factor.open && s.area_m2 >= area * (1.0 - 1e-9)) {
    // Averaged over the receiver, the kernel at y is the form factor from y to the receiver over
    // its area.
    const PointFactor back = open_point_factor(s, r, config_.point_parts);
    factor.mean_spread =
        std::min(factor.mean_spread, area / r.area_m2 * deviation_of_affine(back, s));
    const double most = factor.at_points.range(r.radius_m).hi;
    factor.point_spread = std::min(factor.point_spread, most * point_deviation(r, s));
    factor.point_spread = std::min(factor.point_spread, factor.mean_spread + kernel_shift(r, s));
  }
}

PairFactor PairFactors::operator()(const PatchOfPolygon& receiver, const PatchOfPolygon& shooter,
                                   bool known_open) const {
  PairFactor factor;
  if (receiver.polygon == shooter.polygon) return factor;
  Polygon facing = receiver.shape.polygon, lit = shooter.shape.polygon;
  clip_front(facing, shooter.shape.plane, tolerance_m_);
  if (facing.size() < 3) return factor;
  clip_front(lit, receiver.shape.plane, tolerance_m_);
  if (lit.size() < 3) return factor;
  const FlatShape r(std::move(facing), receiver.shape.plane),
      s(std::move(lit), shooter.shape.plane);

  std::vector<std::uint32_t> between;
  bool many = false;
  if (!known_open) {
    tree_.find(shaft_between(r.polygon, s.polygon, tolerance_m_), tolerance_m_, receiver.polygon,
               shooter.polygon, config_.most_occluders, between);
    many = between.size() > config_.most_occluders;
  }
  factor.open = between.empty();
  // What the pair exchanges roughly, by which its bounds are judged.
  const double about_m2 =
      std::max(1e-6, point_to_polygon(r.center, r.plane.n, s.polygon)) * r.area_m2;
  const Range open = open_flux(r, s, config_.near_share * about_m2,
                               factor.open ? config_.near_depth : config_.near_depth / 2);
  SplitSight sight;
  Range flux = open;
  if (!factor.open) {
    const Between walls = sorted(between);
    sight = many ? SplitSight{{}, {s.polygon}}
                 : split_sight(r, s.polygon, s.plane, walls.polygons, tolerance_m_, walls.panes);
    if (sight.seen.empty() && sight.unsure.empty()) return {};
    if (many) {
      flux.lo = 0.0;
    } else {
      const bool viewer_is_receiver = r.radius_m <= s.radius_m;
      const Pair pair = viewer_is_receiver ? Pair{r, s, receiver.polygon, shooter.polygon}
                                           : Pair{s, r, shooter.polygon, receiver.polygon};
      flux = occluded_flux(pair, pair.viewer, between, config_.sight_share * open.hi,
                           config_.sight_depth);
      flux.hi = std::min(flux.hi, open.hi);
    }
    if (flux.hi <= 0.0) return {};
  }
  factor.mean = {flux.lo / receiver.shape.area_m2, flux.hi / receiver.shape.area_m2};
  bound_points(r, s, factor.open ? nullptr : &sight, factor);
  bound_spreads(receiver.shape, shooter.shape, r, s, factor);
  return factor;
}

}  // namespace enfilade
