#include "bounds/factors/flat_shape.hpp"

#include <array>
#include <cmath>
#include <span>

#include "geometry/clip.hpp"

namespace enfilade {
namespace {

struct GaussNode {
  double x, w;  ///< on [0, 1]
};
constexpr std::array<GaussNode, 2> gauss2{
    {{0.21132486540518711775, 0.5}, {0.78867513459481288225, 0.5}}};
constexpr std::array<GaussNode, 3> gauss3{
    {{0.11270166537925831148, 5.0 / 18.0}, {0.5, 4.0 / 9.0}, {0.88729833462074168852, 5.0 / 18.0}}};
constexpr std::array<GaussNode, 4> gauss4{{{0.06943184420297371239, 0.17392742256872692869},
                                           {0.33000947820757186760, 0.32607257743127307131},
                                           {0.66999052179242813240, 0.32607257743127307131},
                                           {0.93056815579702628761, 0.17392742256872692869}}};
constexpr std::array<GaussNode, 5> gauss5{{{0.04691007703066800360, 0.11846344252809454376},
                                           {0.23076534494715845448, 0.23931433524968323402},
                                           {0.5, 0.28444444444444444444},
                                           {0.76923465505284154552, 0.23931433524968323402},
                                           {0.95308992296933199640, 0.11846344252809454376}}};

bool is_parallelogram(const Polygon& p, double radius_m) {
  return p.size() == 4 && glm::length(p[0] - p[1] + p[2] - p[3]) <= 1e-10 * radius_m;
}

void add_parallelogram(const FlatShape& s, std::span<const GaussNode> rule,
                       std::vector<QuadraturePoint>& out) {
  const Vec3 &a = s.polygon[0], u = s.polygon[1] - a, v = s.polygon[3] - a;
  for (const GaussNode& i : rule) {
    for (const GaussNode& j : rule) out.push_back({a + i.x * u + j.x * v, s.area_m2 * i.w * j.w});
  }
}

/// The triangle as a collapsed square: p = a + s (b - a + t (c - b)), whose area element is
/// proportional to s, so that the rule along s needs one degree more.
void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, std::span<const GaussNode> along_s,
                  std::span<const GaussNode> along_t, std::vector<QuadraturePoint>& out) {
  const double twice_area_m2 = glm::length(glm::cross(b - a, c - a));
  for (const GaussNode& s : along_s) {
    for (const GaussNode& t : along_t) {
      out.push_back({a + s.x * (b - a + t.x * (c - b)), twice_area_m2 * s.w * s.x * t.w});
    }
  }
}

}  // namespace

FlatShape::FlatShape(Polygon corners, const Plane& its_plane)
    : polygon(std::move(corners)), plane(its_plane) {
  if (!polygon.empty()) center = polygon[0];
  if (polygon.size() < 3) return;
  area_m2 = enfilade::area_m2(polygon);
  center = centroid(polygon);
  for (const Vec3& p : polygon) radius_m = std::max(radius_m, glm::length(p - center));
}

void add_quadrature(const FlatShape& shape, bool fine, std::vector<QuadraturePoint>& out) {
  if (is_parallelogram(shape.polygon, shape.radius_m)) {
    if (fine) {
      add_parallelogram(shape, gauss4, out);
    } else {
      add_parallelogram(shape, gauss2, out);
    }
    return;
  }
  for (std::size_t i = 2; i < shape.polygon.size(); ++i) {
    const Vec3 &a = shape.polygon[0], &b = shape.polygon[i - 1], &c = shape.polygon[i];
    if (fine) {
      add_triangle(a, b, c, gauss5, gauss4, out);
    } else {
      add_triangle(a, b, c, gauss3, gauss2, out);
    }
  }
}

double largest_deviation_m(const FlatShape& shape) {
  if (shape.area_m2 <= 0.0) return 0.0;
  const Vec3 u = glm::normalize(shape.polygon[1] - shape.polygon[0]),
             v = glm::cross(shape.plane.n, u);
  std::vector<QuadraturePoint> points;
  add_quadrature(shape, false, points);
  double uu = 0.0, uv = 0.0, vv = 0.0;
  for (const QuadraturePoint& q : points) {
    const double a = glm::dot(u, q.p - shape.center), b = glm::dot(v, q.p - shape.center);
    const double weight = q.weight_m2 / shape.area_m2;
    uu += weight * a * a;
    uv += weight * a * b;
    vv += weight * b * b;
  }
  return std::sqrt(0.5 * (uu + vv) + std::hypot(0.5 * (uu - vv), uv));
}

std::pair<FlatShape, FlatShape> halves(const FlatShape& shape) {
  const Polygon& p = shape.polygon;
  const auto as_shapes = [&](Polygon a, Polygon b) {
    return std::pair{FlatShape(std::move(a), shape.plane), FlatShape(std::move(b), shape.plane)};
  };
  if (is_parallelogram(p, shape.radius_m)) {
    const std::size_t k = glm::length(p[1] - p[0]) >= glm::length(p[2] - p[1]) ? 0 : 1;
    const Vec3 &a = p[k], &b = p[k + 1], &c = p[k + 2], &d = p[(k + 3) % 4];
    const Vec3 ab = 0.5 * (a + b), cd = 0.5 * (c + d);
    return as_shapes({a, ab, cd, d}, {ab, b, c, cd});
  }
  if (p.size() == 3) {
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (glm::length(p[(i + 1) % 3] - p[i]) > glm::length(p[(k + 1) % 3] - p[k])) k = i;
    }
    const Vec3 &a = p[k], &b = p[(k + 1) % 3], &c = p[(k + 2) % 3];
    const Vec3 m = 0.5 * (a + b);
    return as_shapes({a, m, c}, {m, b, c});
  }
  Vec3 longest(0.0);
  for (const Vec3& a : p) {
    for (const Vec3& b : p) {
      if (glm::length(b - a) > glm::length(longest)) longest = b - a;
    }
  }
  const Vec3 n = glm::normalize(longest);
  auto [front, behind] = split(p, {n, glm::dot(n, shape.center)}, 0.0);
  return as_shapes(std::move(front), std::move(behind));
}

}  // namespace enfilade
