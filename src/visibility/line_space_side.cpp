// Points that stand for many vertices: corners of the smaller of two boxes.
#include "visibility/line_space_side.hpp"

#include <algorithm>
#include <array>

namespace enfilade {
namespace {

// The vertices of a side, if more than this, are replaced by the corners of a box: crossings grow
// with the product of both sides' points.
constexpr std::size_t most_side_points = 12;

void add_distinct(std::vector<Vec3>& points, const Polygon& polygon) {
  for (const Vec3& p : polygon) {
    if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
  }
}

struct Corners {
  std::vector<Vec3> points;
  double volume_m3 = 0.0;
};

// The corners of the smallest box along the axes that holds all parts.
Corners corners(const std::vector<LineSpacePart>& parts, const std::array<Vec3, 3>& axes) {
  Box box;
  for (const LineSpacePart& part : parts) box.add(bounds_along(part.polygon(), axes));
  Corners found;
  for (const Vec3& c : box.corners()) {
    found.points.push_back(c.x * axes[0] + c.y * axes[1] + c.z * axes[2]);
  }
  const Vec3 e = box.extent();
  found.volume_m3 = e.x * e.y * e.z;
  return found;
}

// A frame along the largest part: rooms and furniture stand at any angle.
std::array<Vec3, 3> frame_of(const std::vector<LineSpacePart>& parts) {
  const auto area = [](const LineSpacePart& part) { return area_m2(part.polygon()); };
  const auto largest = std::max_element(
      parts.begin(), parts.end(),
      [&](const LineSpacePart& a, const LineSpacePart& b) { return area(a) < area(b); });
  const Polygon& polygon = largest->polygon();
  Vec3 along(0.0);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (glm::dot(edge, edge) > glm::dot(along, along)) along = edge;
  }
  const Vec3& n = largest->plane().n;
  along = glm::normalize(along - glm::dot(along, n) * n);
  return {n, along, glm::cross(n, along)};
}

std::vector<Vec3> corners(const std::vector<LineSpacePart>& parts) {
  Corners straight = corners(parts, {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
  Corners turned = corners(parts, frame_of(parts));
  // The frame of a sliver is not a number, and is not taken either.
  return turned.volume_m3 < straight.volume_m3 ? turned.points : straight.points;
}

}  // namespace

LineSpaceSide side_of(std::vector<LineSpacePart> parts) {
  LineSpaceSide side;
  for (const LineSpacePart& part : parts) {
    side.box.add(bounds(part.polygon()));
    if (side.points.size() <= most_side_points) add_distinct(side.points, part.polygon());
  }
  if (side.points.size() > most_side_points) side.points = corners(parts);
  side.parts = std::move(parts);
  return side;
}

}  // namespace enfilade
