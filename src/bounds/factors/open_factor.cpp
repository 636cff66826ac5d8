#include "bounds/factors/open_factor.hpp"

#include <algorithm>
#include <numbers>

#include "bounds/factors/inverse_power.hpp"

namespace enfilade {
namespace {

using std::numbers::pi;
/// Half width of the range of r^2 over its middle: above `too_wide` a pair is cut before anything
/// is integrated; below `narrow` polynomials of degree 1 are within 0.2% of each other.
constexpr double too_wide = 0.6, narrow = 0.025;
/// Bounds of a flux that differ by this share are not narrowed.
constexpr double close_enough = 0.01;

/// Bounds of the flux by polynomials of r^2; `s` is the range of r^2, s.lo > 0.
Range flux_by_polynomials(const FlatShape& receiver, const FlatShape& shooter, const Range& s) {
  const bool cubic = spread(s) > narrow;
  const PowerBounds power = bound_power(-2.0, s.lo, s.hi, cubic);
  thread_local std::vector<QuadraturePoint> xs, ys;
  xs.clear();
  ys.clear();
  add_quadrature(receiver, cubic, xs);
  add_quadrature(shooter, cubic, ys);
  for (QuadraturePoint& y : ys) y.weight_m2 *= receiver.plane.signed_distance(y.p);
  Range flux;
  for (const QuadraturePoint& x : xs) {
    double below = 0.0, above = 0.0;
    for (const QuadraturePoint& y : ys) {
      const Vec3 d = y.p - x.p;
      const double r2 = glm::dot(d, d);
      below += y.weight_m2 * power.below(r2);
      above += y.weight_m2 * power.above(r2);
    }
    const double weight = x.weight_m2 * shooter.plane.signed_distance(x.p) / pi;
    flux.lo += weight * below;
    flux.hi += weight * above;
  }
  return flux;
}

Range flux_within(const FlatShape& receiver, const FlatShape& shooter, double tolerance_m2,
                  int depth) {
  const Range s = squared_distances(receiver, shooter);
  const Range k = kernel_range(receiver, shooter, s);
  const double areas = receiver.area_m2 * shooter.area_m2;
  const double most = most_by_facing(receiver.plane.n, shooter.plane.n) *
                      std::min(receiver.area_m2, shooter.area_m2);
  Range flux{k.lo * areas, std::min(k.hi < 1e299 ? k.hi * areas : most, most)};
  if (flux.width() <= tolerance_m2) return flux;
  if (s.lo > 0.0 && (spread(s) < too_wide || depth == 0)) {
    const Range closer = flux_by_polynomials(receiver, shooter, s);
    flux = {std::max(flux.lo, closer.lo), std::min(flux.hi, closer.hi)};
  }
  if (depth == 0 || flux.width() <= std::max(tolerance_m2, close_enough * flux.hi)) return flux;
  const bool cut_receiver = receiver.radius_m > shooter.radius_m;
  const auto [first, second] = halves(cut_receiver ? receiver : shooter);
  Range a, b;
  if (cut_receiver) {
    a = flux_within(first, shooter, tolerance_m2, depth - 1);
    b = flux_within(second, shooter, tolerance_m2, depth - 1);
  } else {
    a = flux_within(receiver, first, tolerance_m2, depth - 1);
    b = flux_within(receiver, second, tolerance_m2, depth - 1);
  }
  return {std::max(flux.lo, a.lo + b.lo), std::min(flux.hi, a.hi + b.hi)};
}

}  // namespace

Range open_flux(const FlatShape& receiver, const FlatShape& shooter, double tolerance_m2,
                int depth) {
  return flux_within(receiver, shooter, tolerance_m2, depth);
}

}  // namespace enfilade
