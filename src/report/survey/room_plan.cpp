#include "report/survey/room_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/convex.hpp"
#include "geometry/triangulation.hpp"
#include "report/plans/plan_outline.hpp"

namespace enfilade {
namespace {

/// Of a region's size: corners nearer than this are one.
constexpr double snap_relative = 1e-6;

std::vector<Polygon> triangles_of(const std::vector<Vec2>& outline) {
  Box box;
  for (const Vec2& p : outline) box.add(Vec3(p, 0.0));
  const double size_m = box.diagonal();
  const Triangulation found = triangulate(outline, 1e-6 * size_m * size_m);
  std::vector<Polygon> parts;
  for (const auto& t : found.triangles) {
    Polygon& part = parts.emplace_back();
    for (const std::uint32_t corner : t) part.emplace_back(found.points[corner], 0.0);
  }
  return parts;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double square = glm::dot(along, along);
  const double t = square > 0.0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return glm::length(p - a - t * along);
}

}  // namespace

RoomPlan::RoomPlan(std::vector<Polygon> convex_parts) : parts_(std::move(convex_parts)) {
  Box box;
  for (Polygon& part : parts_) {
    for (Vec3& p : part) p.z = 0.0;
    if (area_vector(part).z < 0.0) std::reverse(part.begin(), part.end());
  }
  const double least_m2 = 1e-9;
  std::erase_if(parts_, [&](const Polygon& part) { return area_vector(part).z < 2.0 * least_m2; });
  for (const Polygon& part : parts_) box.add(bounds(part));
  area_m2_ = total_area_m2(parts_);
  if (!parts_.empty()) rings_ = footprint(parts_, snap_relative * box.diagonal());
}

RoomPlan::RoomPlan(const std::vector<Vec2>& outline) : RoomPlan(triangles_of(outline)) {}

bool RoomPlan::contains(const Vec2& p) const {
  return std::ranges::any_of(parts_, [&](const Polygon& part) {
    return enfilade::contains(part, Vec3(0, 0, 1), Vec3(p, 0.0));
  });
}

double RoomPlan::distance_to_edge(const Vec2& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& ring : rings_) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      least = std::min(least, distance_to_segment(p, ring[i], ring[(i + 1) % ring.size()]));
  }
  return least;
}

PlanRectangle RoomPlan::rectangle() const {
  std::vector<Vec3> corners;
  for (const Polygon& part : parts_) corners.insert(corners.end(), part.begin(), part.end());
  if (corners.empty()) return {};
  const Polygon hull = convex_hull(corners, Vec3(0, 0, 1));
  PlanRectangle best;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](Vec2 along) {
    Vec2 across(-along.y, along.x);
    Vec2 lo(std::numeric_limits<double>::infinity()), hi = -lo;
    for (const Vec3& p : hull) {
      const Vec2 at(glm::dot(Vec2(p), along), glm::dot(Vec2(p), across));
      lo = glm::min(lo, at);
      hi = glm::max(hi, at);
    }
    const Vec2 size = hi - lo;
    if (size.x * size.y >= least * (1.0 - 1e-6)) return;
    least = size.x * size.y;
    best = {lo.x * along + lo.y * across, along, size.x, size.y};
  };
  consider({1.0, 0.0});
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = Vec2(hull[(i + 1) % hull.size()] - hull[i]);
    if (glm::length(edge) > 0.0) consider(glm::normalize(edge));
  }
  if (best.length_m >= best.width_m) return best;
  // The same rectangle by its other side.
  const Vec2 across(-best.along.y, best.along.x);
  return {best.at(best.length_m, 0.0), across, best.width_m, best.length_m};
}

std::vector<Vec2> RoomPlan::spread(std::size_t count) const {
  std::vector<Vec2> points;
  if (empty()) return points;
  const PlanRectangle box = rectangle();
  const double step_m = std::sqrt(area_m2_ / static_cast<double>(std::max<std::size_t>(count, 1)));
  const auto steps = [&](double side_m) { return std::max(1.0, std::ceil(side_m / step_m)); };
  const double columns = steps(box.length_m), rows = steps(box.width_m);
  for (double j = 0.5; j < rows; ++j) {
    for (double i = 0.5; i < columns; ++i) {
      const Vec2 p = box.at(i / columns * box.length_m, j / rows * box.width_m);
      if (contains(p)) points.push_back(p);
    }
  }
  if (points.empty()) points.push_back(middle());
  return points;
}

Vec2 RoomPlan::middle() const {
  const InnerCircle circle = largest_circle(parts_);
  return circle.radius_m > 0.0 || parts_.empty() ? circle.centre : Vec2(centroid(parts_[0]));
}

}  // namespace enfilade
