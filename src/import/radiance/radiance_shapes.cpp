#include "import/radiance/radiance_shapes.hpp"

#include <cmath>
#include <numbers>

namespace enfilade {
namespace {

using std::numbers::pi;

/// A circle's polygon; all points in one where the radius is 0.
Polygon circle(const Vec3& center, const Vec3& x, const Vec3& y, double radius, int sides) {
  Polygon points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * pi * i / sides;
    points.push_back(center + radius * (std::cos(angle) * x + std::sin(angle) * y));
  }
  return points;
}

/// Polygons between two circles of equally many points that run counter-clockwise seen against the
/// axis from `low` to `high`; they face outward. A circle without radius makes them triangles.
void add_band(const Polygon& low, const Polygon& high, std::vector<Polygon>& polygons) {
  const std::size_t n = low.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    Polygon quad{low[i], low[next], high[next], high[i]};
    if (high[i] == high[next]) quad.pop_back();
    if (low[i] == low[next]) quad.erase(quad.begin());
    polygons.push_back(std::move(quad));
  }
}

/// A frame about an axis. The opposite axis has the same x, so that shapes which meet have their
/// corners at the same places whichever way they point.
struct AxisFrame {
  Vec3 axis, x, y;
  explicit AxisFrame(const Vec3& direction) : axis(glm::normalize(direction)) {
    const Vec3 least = least_axis(axis);
    x = glm::normalize(least - glm::dot(least, axis) * axis);
    y = glm::cross(axis, x);
  }
  Polygon circle_at(const Vec3& center, double radius) const {
    // A regular polygon of n corners at distance 1 has an area of n/2 sin(2 pi/n).
    const double equal_area =
        std::sqrt(pi / (0.5 * radiance_sides * std::sin(2.0 * pi / radiance_sides)));
    return circle(center, x, y, equal_area * radius, radiance_sides);
  }
};

Vec3 point_at(const RadiancePrimitive& shape, std::size_t i) {
  return {shape.numbers[i], shape.numbers[i + 1], shape.numbers[i + 2]};
}

void need_radii(const RadiancePrimitive& shape, double a, double b, bool differ) {
  if (a >= 0.0 && b >= 0.0 && (differ ? a != b : a + b > 0.0)) return;
  shape.place.fail(shape.label() + " has a radius that leaves it no area or is below zero",
                   "correct the radius, or take the shape out");
}

void need_length(const RadiancePrimitive& shape, const Vec3& axis) {
  if (glm::length(axis) > 0.0) return;
  shape.place.fail(shape.label() + " has an axis of no length", "write two different points");
}

std::vector<Polygon> polygon_of(const RadiancePrimitive& shape) {
  const std::size_t count = shape.numbers.size();
  if (count < 9 || count % 3 != 0) {
    shape.place.fail(shape.label() + " has " + std::to_string(count) + " numbers",
                     "write x y z of 3 or more corners");
  }
  Polygon polygon;
  for (std::size_t i = 0; i < count; i += 3) polygon.push_back(point_at(shape, i));
  return {std::move(polygon)};
}

std::vector<Polygon> ring(const RadiancePrimitive& shape) {
  shape.need_numbers(8, "x y z of the center and of the direction, and two radii");
  const double inner = std::min(shape.numbers[6], shape.numbers[7]);
  const double outer = std::max(shape.numbers[6], shape.numbers[7]);
  need_radii(shape, inner, outer, true);
  need_length(shape, point_at(shape, 3));
  const AxisFrame frame(point_at(shape, 3));
  const Polygon outline = frame.circle_at(point_at(shape, 0), outer);
  if (inner == 0.0) return {outline};
  std::vector<Polygon> polygons;
  add_band(outline, frame.circle_at(point_at(shape, 0), inner), polygons);
  return polygons;
}

std::vector<Polygon> pipe(const RadiancePrimitive& shape, bool conical) {
  if (conical)
    shape.need_numbers(8, "x y z of both ends, and two radii");
  else
    shape.need_numbers(7, "x y z of both ends, and the radius");
  const Vec3 low = point_at(shape, 0), high = point_at(shape, 3);
  const double low_radius = shape.numbers[6], high_radius = shape.numbers.back();
  need_radii(shape, low_radius, high_radius, false);
  need_length(shape, high - low);
  const AxisFrame frame(high - low);
  std::vector<Polygon> polygons;
  add_band(frame.circle_at(low, low_radius), frame.circle_at(high, high_radius), polygons);
  return polygons;
}

std::vector<Polygon> sphere(const RadiancePrimitive& shape) {
  shape.need_numbers(4, "x y z of the center, and the radius");
  const double radius = shape.numbers[3];
  need_radii(shape, radius, radius, false);
  constexpr int bands = radiance_sphere_sides / 2;
  const auto circle_of_band = [](int band) {
    const double angle = pi * (static_cast<double>(band) / bands - 0.5);
    const bool pole = band == 0 || band == bands;
    return circle({0, 0, std::sin(angle)}, {1, 0, 0}, {0, 1, 0}, pole ? 0.0 : std::cos(angle),
                  radiance_sphere_sides);
  };
  std::vector<Polygon> polygons;
  for (int band = 0; band < bands; ++band)
    add_band(circle_of_band(band), circle_of_band(band + 1), polygons);
  double area = 0.0;
  for (const Polygon& polygon : polygons) area += area_m2(polygon);
  const double scale = radius * std::sqrt(4.0 * pi / area);
  for (Polygon& polygon : polygons) {
    for (Vec3& p : polygon) p = point_at(shape, 0) + scale * p;
  }
  return polygons;
}

}  // namespace

std::vector<Polygon> radiance_polygons(const RadiancePrimitive& shape) {
  const std::string& type = shape.type;
  if (type == "polygon") return polygon_of(shape);
  if (type == "ring") return ring(shape);
  std::vector<Polygon> polygons = type == "sphere" || type == "bubble"
                                      ? sphere(shape)
                                      : pipe(shape, type == "cone" || type == "cup");
  if (type == "bubble" || type == "tube" || type == "cup") {  // the same, seen from the inside
    for (Polygon& polygon : polygons) std::reverse(polygon.begin(), polygon.end());
  }
  return polygons;
}

}  // namespace enfilade
