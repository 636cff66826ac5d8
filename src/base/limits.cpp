#include "base/limits.hpp"

#include <cmath>

namespace enfilade::limits {
namespace {

double largest(const Vec3& v) {
  const Vec3 a = glm::abs(v);
  return std::max({a.x, a.y, a.z});
}

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

Fault fault_of_place(const Vec3& p) {
  if (is_finite(p) && largest(p) <= farthest_m) return {};
  return {"lies beyond 1e9 m", "check the numbers and the unit of length"};
}

Fault fault_of_opening(const Vec3& size) {
  for (const double extent : {size.x, size.y, size.z}) {
    if (extent != 0.0 && !(extent >= smallest_opening_m && extent <= largest_opening_m))
      return {"has a length out of range", "write 0, or lengths from 1e-6 m to 10 km"};
  }
  return {};
}

Fault fault_of_light(double light) {
  if (!std::isfinite(light)) return {"not a finite number", "write a number"};
  if (light < 0.0) return {"below zero", "write 0 or more"};
  if (light > most_light) {
    return {"more than numbers can carry on with", "write it in a larger unit: at most 1e30"};
  }
  if (light > 0.0 && light < least_light) {
    return {"less than numbers can carry on with",
            "write 0, or write it in a smaller unit: at least 1e-30"};
  }
  return {};
}

Fault fault_of_count(std::size_t count, std::size_t most, const std::string& things) {
  if (count <= most) return {};
  return {"has " + std::to_string(count) + " " + things,
          "at most " + std::to_string(most) + " can be read: split it"};
}

Fault fault_of_direction(const Vec3& v) {
  if (!is_finite(v)) return {"is not finite", "write a direction, such as [0, 0, 1]"};
  if (largest(v) > 0.0) return {};
  return {"has no length", "write a direction, such as [0, 0, 1]"};
}

Vec3 unit(const Vec3& v) {
  // By its exponent first, so that no square overflows or vanishes.
  const int exponent = std::ilogb(largest(v));
  return glm::normalize(
      Vec3(std::scalbn(v.x, -exponent), std::scalbn(v.y, -exponent), std::scalbn(v.z, -exponent)));
}

}  // namespace enfilade::limits
