#include "bounds/open_factor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bounds/inverse_power.hpp"
#include "geometry/form_factor.hpp"

namespace enfilade {
namespace {

constexpr double pi = std::numbers::pi;
/// Half width of the range of r^2 over its middle: above `too_wide` a pair is cut before anything
/// is integrated; below `narrow` polynomials of degree 1 are within 0.2% of each other.
constexpr double too_wide = 0.6, narrow = 0.025;
/// A remainder of this share of the factor is good enough to look for no other description.
constexpr double good_remainder = 0.3;
/// Bounds of a flux that differ by this share are not narrowed.
constexpr double close_enough = 0.01;

/// Range of the signed distances of a polygon's corners from a plane, at least 0.
Range heights(const FlatShape& shape, const Plane& plane) {
  Range range{1e300, 0.0};
  for (const Vec3& p : shape.polygon) {
    const double height = plane.signed_distance(p);
    range.lo = std::min(range.lo, height);
    range.hi = std::max(range.hi, height);
  }
  return {std::max(0.0, range.lo), range.hi};
}

double gap_along(const FlatShape& a, const FlatShape& b, const Vec3& axis) {
  Range of_a{1e300, -1e300}, of_b{1e300, -1e300};
  for (const auto& [shape, range] : {std::pair{&a, &of_a}, std::pair{&b, &of_b}}) {
    for (const Vec3& p : shape->polygon) {
      const double x = glm::dot(axis, p);
      range->lo = std::min(range->lo, x);
      range->hi = std::max(range->hi, x);
    }
  }
  return std::max({0.0, of_a.lo - of_b.hi, of_b.lo - of_a.hi});
}

double gap_in_frame(const FlatShape& a, const FlatShape& b, const Vec3& n, const Vec3& edge) {
  const double length = glm::length(edge);
  if (length <= 0.0) return 0.0;
  const Vec3 u = edge / length, v = glm::cross(n, u);
  return glm::length(Vec3(gap_along(a, b, n), gap_along(a, b, u), gap_along(a, b, v)));
}

/// Half width over middle of the range of squared distances.
double spread(const Range& s) { return s.hi > 0.0 ? (s.hi - s.lo) / (s.hi + s.lo) : 1.0; }

Range squared_distances(const FlatShape& a, const FlatShape& b) {
  const double least = least_distance(a, b), most = largest_distance(a, b);
  return {least * least, std::max(least * least, most * most)};
}

Range kernel_range(const FlatShape& receiver, const FlatShape& shooter, const Range& s) {
  const Range a = heights(shooter, receiver.plane), b = heights(receiver, shooter.plane);
  Range k;
  k.lo = s.hi > 0.0 ? a.lo * b.lo / (pi * s.hi * s.hi) : 0.0;
  k.hi = s.lo > 0.0 ? std::min(a.hi * b.hi / (s.lo * s.lo), 1.0 / s.lo) / pi : 1e300;
  return k;
}

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

/// The closed form at the receiver's centre with its gradient; the remainder follows from Taylor's
/// formula for r^-4 about the centre: |second derivative of s^-2| = 6 s^-4.
PointFactor taylor(const FlatShape& receiver, const FlatShape& shooter, double least_m) {
  const double radius = receiver.radius_m;
  const double b_c = shooter.plane.signed_distance(receiver.center);
  const Range b = heights(receiver, shooter.plane);
  PointFactor f;
  f.center = point_to_polygon(receiver.center, receiver.plane.n, shooter.polygon);
  // F(c + t) = b(c + t) g(t), g(t) = g0 + t . g1 + rest.
  const Vec3 n = receiver.plane.n;
  const Vec3 slope_b = shooter.plane.n - glm::dot(shooter.plane.n, n) * n;
  Range s_c{1e300, 0.0};  // of r^2 from the centre
  const double nearest = least_distance(FlatShape{{receiver.center}, receiver.plane}, shooter);
  for (const Vec3& y : shooter.polygon) {
    const Vec3 d = y - receiver.center;
    s_c.hi = std::max(s_c.hi, glm::dot(d, d));
  }
  s_c.lo = std::max(nearest, least_m) * std::max(nearest, least_m);
  // g1 = 4/pi int a d s^-3, with s^-3 interpolated at three Chebyshev nodes: a polynomial, whose
  // integral is exact, and an error of at most 10 s^-6 h^3 / 4.
  const double middle = 0.5 * (s_c.lo + s_c.hi), h = 0.5 * (s_c.hi - s_c.lo);
  std::array<double, 3> node{middle - 0.5 * std::sqrt(3.0) * h, middle,
                             middle + 0.5 * std::sqrt(3.0) * h};
  std::array<double, 3> value{};
  for (std::size_t i = 0; i < 3; ++i) value[i] = 1.0 / (node[i] * node[i] * node[i]);
  const double flat = h <= 1e-6 * middle ? 0.0 : 1.0;
  const double first = flat > 0.0 ? (value[1] - value[0]) / (node[1] - node[0]) : 0.0;
  const double last = flat > 0.0 ? (value[2] - value[1]) / (node[2] - node[1]) : 0.0;
  const double second = flat > 0.0 ? (last - first) / (node[2] - node[0]) : 0.0;
  thread_local std::vector<QuadraturePoint> ys;
  ys.clear();
  add_quadrature(shooter, true, ys);
  Vec3 g1(0.0);
  for (const QuadraturePoint& y : ys) {
    const Vec3 d = y.p - receiver.center;
    const double s = glm::dot(d, d);
    const double cube = value[0] + (s - node[0]) * (first + (s - node[1]) * second);
    g1 += y.weight_m2 * receiver.plane.signed_distance(y.p) * cube * d;
  }
  g1 *= 4.0 / pi;
  g1 -= glm::dot(g1, n) * n;
  const double g0 = b_c > 0.0 ? f.center / b_c : 0.0;
  f.gradient = b_c * g1 + g0 * slope_b;
  const double a_integral = shooter.area_m2 * receiver.plane.signed_distance(shooter.center);
  const double s_lo3 = s_c.lo * s_c.lo * s_c.lo;
  const double interpolation_error = flat > 0.0 ? 2.5 * h * h * h / (s_lo3 * s_lo3) : 3e-6 / s_lo3;
  const double g1_error = 4.0 / pi * a_integral * std::sqrt(s_c.hi) * interpolation_error;
  // rest: -2 t^2/pi int a s^-3, and 1/pi int a (3 sigma^-4 delta^2), delta = -2 t.d + t^2, sigma
  // between s and the squared distance from c + t. Both factors fall with s, and are convex: below
  // their chords, whose integrals are exact.
  const auto second_order = [&](double squared) {
    const double r = std::sqrt(squared), least_sigma = std::max(least_m, r - radius);
    const double delta = 2.0 * radius * r + radius * radius;
    return 3.0 * delta * delta / std::pow(least_sigma, 8.0);
  };
  // Where r - radius < least_m it is the numerator alone that grows: the bound there is constant.
  const double knee = (least_m + radius) * (least_m + radius);
  const double at_lo = second_order(std::max(s_c.lo, knee)),
               at_hi = second_order(std::max(s_c.hi, knee));
  const double rise = s_c.lo >= knee && s_c.hi > s_c.lo ? (at_hi - at_lo) / (s_c.hi - s_c.lo) : 0.0;
  double chord = 0.0, cubes = 0.0;
  const double cube_lo = 1.0 / s_lo3, cube_hi = 1.0 / (s_c.hi * s_c.hi * s_c.hi);
  const double cube_rise = s_c.hi > s_c.lo ? (cube_hi - cube_lo) / (s_c.hi - s_c.lo) : 0.0;
  for (const QuadraturePoint& y : ys) {
    const Vec3 d = y.p - receiver.center;
    const double past = glm::dot(d, d) - s_c.lo;
    const double weight = y.weight_m2 * receiver.plane.signed_distance(y.p) / pi;
    chord += weight * (at_lo + rise * past);
    cubes += weight * (cube_lo + cube_rise * past);
  }
  const double rest = std::max(2.0 * radius * radius * cubes, chord);
  f.remainder = b.hi * (rest + radius * g1_error) +
                glm::length(slope_b) * radius * radius * (glm::length(g1) + g1_error);
  return f;
}

Range point_range(const FlatShape& receiver, const FlatShape& shooter, int depth) {
  const Range s = squared_distances(receiver, shooter);
  const Range k = kernel_range(receiver, shooter, s);
  if (depth == 0 || spread(s) < 0.25) return {k.lo * shooter.area_m2, k.hi * shooter.area_m2};
  const auto [first, second] = halves(shooter);
  const Range a = point_range(receiver, first, depth - 1),
              b = point_range(receiver, second, depth - 1);
  return {a.lo + b.lo, a.hi + b.hi};
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

double least_distance(const FlatShape& a, const FlatShape& b) {
  double least = 0.0;
  const Vec3 between = b.center - a.center;
  if (const double length = glm::length(between); length > 0.0)
    least = std::max(least, gap_along(a, b, between / length));
  for (const FlatShape* shape : {&a, &b}) {
    if (shape->polygon.size() < 2) continue;
    least =
        std::max(least, gap_in_frame(a, b, shape->plane.n, shape->polygon[1] - shape->polygon[0]));
  }
  return least;
}

double largest_distance(const FlatShape& a, const FlatShape& b) {
  double most = 0.0;
  for (const Vec3& p : a.polygon) {
    for (const Vec3& q : b.polygon) most = std::max(most, glm::dot(q - p, q - p));
  }
  return std::sqrt(most);
}

double most_by_facing(const Vec3& n, const Vec3& m) {
  return std::clamp(0.5 * (1.0 - glm::dot(n, m)), 0.0, 1.0);
}

Range kernel_range(const FlatShape& receiver, const FlatShape& shooter) {
  return kernel_range(receiver, shooter, squared_distances(receiver, shooter));
}

Range open_flux(const FlatShape& receiver, const FlatShape& shooter, double tolerance_m2,
                int depth) {
  return flux_within(receiver, shooter, tolerance_m2, depth);
}

Range open_point_range(const FlatShape& receiver, const FlatShape& shooter, int depth) {
  Range f = point_range(receiver, shooter, depth);
  f.hi = std::min(f.hi, most_by_facing(receiver.plane.n, shooter.plane.n));
  f.lo = std::min(f.lo, f.hi);
  return f;
}

/// The narrower of the two descriptions that hold for one shape.
static PointFactor one_point_factor(const FlatShape& receiver, const FlatShape& shooter,
                                    int depth) {
  const double least = least_distance(receiver, shooter);
  PointFactor affine;
  if (least > 0.5 * receiver.radius_m) {
    affine = taylor(receiver, shooter, least);
    if (affine.remainder <= good_remainder * affine.center) return affine;
  }
  const Range f = open_point_range(receiver, shooter, depth);
  const PointFactor plain{0.5 * (f.lo + f.hi), Vec3(0.0), 0.5 * f.width()};
  return affine.center > 0.0 && affine.remainder < plain.remainder ? affine : plain;
}

PointFactor open_point_factor(const FlatShape& receiver, const FlatShape& shooter, int parts) {
  if (parts <= 0) return one_point_factor(receiver, shooter, 1);
  PointFactor whole = one_point_factor(receiver, shooter, 3);
  if (whole.remainder <= 0.04 * whole.center) return whole;
  // The parts' own affine functions lie closer to the factor; how far they are from the whole's is
  // seen at their corners.
  const auto [a, b] = halves(receiver);
  const PointFactor of_a = open_point_factor(a, shooter, parts - 1);
  const PointFactor of_b = open_point_factor(b, shooter, parts - 1);
  PointFactor joined = whole;
  if (glm::dot(joined.gradient, joined.gradient) == 0.0 && whole.remainder > 0.3 * whole.center) {
    const Vec3 between = b.center - a.center;
    joined.gradient = between * ((of_b.center - of_a.center) / glm::dot(between, between));
  }
  Range off{1e300, -1e300};
  for (const auto& [part, f] : {std::pair{&a, &of_a}, std::pair{&b, &of_b}}) {
    for (const Vec3& p : part->polygon) {
      const double here = f->center + glm::dot(f->gradient, p - part->center) - joined.center -
                          glm::dot(joined.gradient, p - receiver.center);
      off.lo = std::min(off.lo, here - f->remainder);
      off.hi = std::max(off.hi, here + f->remainder);
    }
  }
  joined.center += 0.5 * (off.lo + off.hi);
  joined.remainder = 0.5 * off.width();
  return joined.remainder < whole.remainder ? joined : whole;
}

double point_deviation(const FlatShape& receiver, const FlatShape& shooter) {
  const double least = least_distance(receiver, shooter);
  const Range a = heights(shooter, receiver.plane);
  if (least <= 0.0 || a.lo <= 0.0) return 1e300;
  const double stretch = (least + 2.0 * shooter.radius_m) / least;
  const double ratio = a.hi / a.lo * stretch * stretch * stretch * stretch;
  return (ratio - 1.0) / std::sqrt(ratio);
}

double kernel_shift(const FlatShape& receiver, const FlatShape& shooter) {
  const double least = least_distance(receiver, shooter);
  if (least <= 0.0) return 1e300;
  const Range a = heights(shooter, receiver.plane), b = heights(receiver, shooter.plane);
  const double cosine = glm::dot(receiver.plane.n, shooter.plane.n);
  const double slope = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));  // of a, and of b
  const double s = least * least;
  const double mixed =
      (slope * slope + 4.0 * slope * (a.hi + b.hi) / least + 28.0 * a.hi * b.hi / s) / (pi * s * s);
  const double apart = receiver.radius_m + std::numbers::sqrt2 * largest_deviation_m(receiver);
  return shooter.area_m2 * mixed * apart * std::numbers::sqrt2 * largest_deviation_m(shooter);
}

double deviation_of_affine(const PointFactor& f, const FlatShape& shape) {
  thread_local std::vector<QuadraturePoint> points;
  points.clear();
  add_quadrature(shape, false, points);
  double variance = 0.0;
  for (const QuadraturePoint& q : points) {
    const double off = glm::dot(f.gradient, q.p - shape.center);
    variance += q.weight_m2 * off * off;
  }
  return std::sqrt(variance / shape.area_m2) + f.remainder;
}

}  // namespace enfilade
