#include "bounds/factors/point_factor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/form_factor.hpp"

namespace enfilade {
namespace {

using std::numbers::pi;
/// A remainder of this share of the factor is good enough to look for no other description.
constexpr double good_remainder = 0.3;

/// s^-3 interpolated at three Chebyshev nodes of a range, and how far off that is at most:
/// |third derivative| / 6 <= 10 s^-6, times h^3 / 4.
class InverseCube {
 public:
  explicit InverseCube(const Range& s) {
    const double middle = 0.5 * (s.lo + s.hi), h = 0.5 * (s.hi - s.lo);
    node_ = {middle - 0.5 * std::sqrt(3.0) * h, middle, middle + 0.5 * std::sqrt(3.0) * h};
    for (std::size_t i = 0; i < 3; ++i) value_[i] = std::pow(node_[i], -3.0);
    if (h <= 1e-6 * middle) {  // a constant, off by 3 s^-4 h at most
      error_ = 3e-6 * std::pow(s.lo, -3.0) * (middle / s.lo);
      return;
    }
    first_ = (value_[1] - value_[0]) / (node_[1] - node_[0]);
    second_ = ((value_[2] - value_[1]) / (node_[2] - node_[1]) - first_) / (node_[2] - node_[0]);
    error_ = 2.5 * h * h * h * std::pow(s.lo, -6.0);
  }
  double operator()(double s) const {
    return value_[0] + (s - node_[0]) * (first_ + (s - node_[1]) * second_);
  }
  double error() const { return error_; }

 private:
  std::array<double, 3> node_{}, value_{};
  double first_ = 0.0, second_ = 0.0, error_ = 0.0;
};

/// What is left of g(t) = 1/pi int a(y) |y - c - t|^-4 beyond first order: -2 t^2/pi int a s^-3,
/// and 1/pi int a (3 sigma^-4 delta^2), delta = -2 t.d + t^2, sigma between s and the squared
/// distance from c + t. Both factors fall with s, and are convex: below their chords, whose
/// integrals are exact.
double second_order_rest(const FlatShape& receiver, const Range& s_c, double least_m,
                         const std::vector<QuadraturePoint>& ys) {
  const double radius = receiver.radius_m;
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
  const double cube_lo = std::pow(s_c.lo, -3.0), cube_hi = std::pow(s_c.hi, -3.0);
  const double cube_rise = s_c.hi > s_c.lo ? (cube_hi - cube_lo) / (s_c.hi - s_c.lo) : 0.0;
  for (const QuadraturePoint& y : ys) {
    const Vec3 d = y.p - receiver.center;
    const double past = glm::dot(d, d) - s_c.lo;
    const double weight = y.weight_m2 * receiver.plane.signed_distance(y.p) / pi;
    chord += weight * (at_lo + rise * past);
    cubes += weight * (cube_lo + cube_rise * past);
  }
  return std::max(2.0 * radius * radius * cubes, chord);
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
  const InverseCube inverse_cube(s_c);
  thread_local std::vector<QuadraturePoint> ys;
  ys.clear();
  add_quadrature(shooter, true, ys);
  Vec3 g1(0.0);
  for (const QuadraturePoint& y : ys) {
    const Vec3 d = y.p - receiver.center;
    const double s = glm::dot(d, d);
    g1 += y.weight_m2 * receiver.plane.signed_distance(y.p) * inverse_cube(s) * d;
  }
  g1 *= 4.0 / pi;
  g1 -= glm::dot(g1, n) * n;
  const double g0 = b_c > 0.0 ? f.center / b_c : 0.0;
  f.gradient = b_c * g1 + g0 * slope_b;
  const double a_integral = shooter.area_m2 * receiver.plane.signed_distance(shooter.center);
  const double g1_error = 4.0 / pi * a_integral * std::sqrt(s_c.hi) * inverse_cube.error();
  const double rest = second_order_rest(receiver, s_c, least_m, ys);
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

/// The narrower of the two descriptions that hold for one shape.
PointFactor one_point_factor(const FlatShape& receiver, const FlatShape& shooter, int depth) {
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

}  // namespace

Range open_point_range(const FlatShape& receiver, const FlatShape& shooter, int depth) {
  Range f = point_range(receiver, shooter, depth);
  f.hi = std::min(f.hi, most_by_facing(receiver.plane.n, shooter.plane.n));
  f.lo = std::min(f.lo, f.hi);
  return f;
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
