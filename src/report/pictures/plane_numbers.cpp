#include "report/pictures/plane_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace enfilade {
namespace {

/// cos of the angle between surfaces that count as one plane.
constexpr double same_direction = 0.999999;

struct PolygonPlane {
  double offset_m;
  Vec3 n, origin;
  std::uint32_t polygon;
};

}  // namespace

std::vector<std::uint32_t> plane_numbers(const SolvedScene& solved, double tolerance_m) {
  std::vector<PolygonPlane> planes;
  // Offsets are told from within the building: far from the origin a normal's rounding would count.
  std::optional<Vec3> middle;
  for (const ClusterState& state : solved.states) {
    for (const PolygonFrame& frame : state.patches().frames()) {
      if (!middle) middle = frame.origin;
      planes.push_back({glm::dot(frame.n, frame.origin - *middle), frame.n, frame.origin,
                        static_cast<std::uint32_t>(planes.size())});
    }
  }
  std::vector<std::uint32_t> numbers(planes.size());
  std::ranges::stable_sort(planes, {}, &PolygonPlane::offset_m);
  // The first polygon of each plane, by offset; those before `near` lie too far away.
  std::vector<PolygonPlane> first;
  std::size_t near = 0;
  for (const PolygonPlane& plane : planes) {
    while (near < first.size() && first[near].offset_m < plane.offset_m - tolerance_m) ++near;
    const auto same = std::find_if(
        first.begin() + static_cast<std::ptrdiff_t>(near), first.end(),
        [&](const PolygonPlane& other) {
          return glm::dot(plane.n, other.n) > same_direction &&
                 std::abs(glm::dot(plane.origin - other.origin, other.n)) < tolerance_m;
        });
    numbers[plane.polygon] = static_cast<std::uint32_t>(same - first.begin());
    if (same == first.end()) first.push_back(plane);
  }
  return numbers;
}

}  // namespace enfilade
