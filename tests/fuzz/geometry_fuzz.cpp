// The geometry kernels on any numbers: factors lie in [0, 1], cutting keeps the area, parts are
// convex and planar.
#include <algorithm>
#include <cmath>

#include "fuzz_target.hpp"
#include "geometry/clip.hpp"
#include "geometry/convex_merge.hpp"
#include "geometry/form_factor.hpp"
#include "scene/convex_parts.hpp"

namespace enfilade::fuzz {
namespace {

class Numbers {
 public:
  Numbers(const std::uint8_t* data, std::size_t size) : data_(data), end_(data + size) {}
  bool empty() const { return data_ == end_; }
  std::uint8_t byte() { return empty() ? std::uint8_t{0} : *data_++; }
  /// Mostly of a coarse grid, so that points and edges coincide; sometimes a step off it.
  double coordinate() {
    const std::uint8_t b = byte();
    const double grid = (b & 15) - 7.0;
    if (b < 0xC0) return grid;
    return b < 0xE0 ? grid + 1e-9 * (byte() - 128.0) : grid * std::pow(10.0, (byte() & 7) - 4.0);
  }
  Vec3 point() {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
  }

 private:
  const std::uint8_t *data_, *end_;
};

/// Area vectors add up, whether or not a polygon is quite planar.
void require_same(const Vec3& sum, const Vec3& whole, double extent, double more_m2 = 0.0) {
  require(glm::length(sum - whole) <= 1e-6 * extent * extent + more_m2);
}

void check_factor(const Vec3& x, const Vec3& direction, const Polygon& polygon) {
  const double length = glm::length(direction);
  if (!(length > 0.0)) return;
  const double f = point_to_polygon(x, direction / length, polygon);
  require(f >= 0.0 && f <= 1.0 + 1e-9);
}

void check_cut(const Polygon& polygon, const Vec3& through, const Vec3& direction) {
  const double length = glm::length(direction), extent = bounds(polygon).diagonal();
  if (!(length > 0.0)) return;
  const Plane plane{direction / length, glm::dot(direction / length, through)};
  const auto [front, behind] = split(polygon, plane, 1e-9 * extent);
  // A bent polygon may cross the cut more than twice: along an edge, and the more the flatter the
  // cut is to it.
  double bend = 0.0;
  const Plane own = plane_of(polygon);
  const double sine = glm::length(glm::cross(own.n, plane.n));
  for (const Vec3& p : polygon) bend = std::max(bend, std::abs(own.signed_distance(p)));
  require(bend <= 2.0 * most_bend * extent);
  require_same(area_vector(front) + area_vector(behind), area_vector(polygon), extent,
               4.0 * bend * extent / std::max(sine, 1e-9));
}

void check_cover(const Polygon& a, const Polygon& b, const SceneScale& scale) {
  const Plane plane = plane_of(a);
  Polygon flat;  // b laid into a's plane
  for (const Vec3& v : b) flat.push_back(v - plane.signed_distance(v) * plane.n);
  const ConvexParts parts = convex_parts(flat, scale);
  if (parts.shape != PolygonShape::convex) return;
  const double tolerance = 1e-9 * bounds(a).diagonal();
  Vec3 sum = area_vector(intersect_coplanar(a, parts.parts[0], tolerance));
  for (const Polygon& part : subtract_coplanar(a, parts.parts[0], tolerance)) {
    sum += area_vector(part);
  }
  require_same(sum, area_vector(a), bounds(a).diagonal());
}

}  // namespace
}  // namespace enfilade::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace enfilade;
  fuzz::Numbers in(data, size);
  const Vec3 x = in.point(), direction = in.point();
  Scene scene;
  while (!in.empty() && scene.surfaces.size() < 4) {
    Surface surface;
    for (int left = 3 + (in.byte() & 7); left > 0; --left) surface.vertices.push_back(in.point());
    scene.surfaces.push_back(std::move(surface));
  }
  if (scene.surfaces.empty()) return 0;
  const SceneScale scale(scene);
  std::vector<Polygon> convex;
  for (const Surface& surface : scene.surfaces) {
    for (const Polygon& part : convex_parts(surface.vertices, scale).parts) {
      fuzz::require(part.size() >= 3 && std::isfinite(area_m2(part)));
      fuzz::check_factor(x, direction, part);
      fuzz::check_cut(part, x, direction);
      convex.push_back(part);
    }
  }
  for (std::size_t i = 1; i < convex.size(); ++i) {
    fuzz::check_cover(convex[i - 1], convex[i], scale);
  }
  return 0;
}
