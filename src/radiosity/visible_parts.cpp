#include "radiosity/visible_parts.hpp"

#include <cmath>

namespace enfilade {
namespace {

/// The shadow of a convex polygon seen from x, as planes with the shadow behind each: the cone
/// through its edges, beyond its own plane. Where x lies in that plane there is none.
std::vector<Plane> shadow_of(const Vec3& x, const Polygon& blocker, double tolerance_m) {
  Plane beyond = plane_of(blocker);
  const double height_m = beyond.signed_distance(x);
  if (std::abs(height_m) <= tolerance_m) return {};
  if (height_m < 0.0) beyond = {-beyond.n, -beyond.d};
  const Vec3 middle = centroid(blocker) - x;
  std::vector<Plane> planes{beyond};
  for (std::size_t i = 0; i < blocker.size(); ++i) {
    const Vec3 a = blocker[i] - x, b = blocker[(i + 1) % blocker.size()] - x;
    Vec3 n = glm::cross(a, b);
    const double length = glm::length(n);
    if (length <= 1e-14 * glm::length(a) * glm::length(b)) continue;
    n /= glm::dot(n, middle) > 0.0 ? -length : length;
    planes.push_back({n, glm::dot(n, x)});
  }
  return planes;
}

/// Appends to `lit` what of the part is not in the shadow.
void cut_out(Polygon part, std::span<const Plane> shadow, double tolerance_m,
             std::vector<Polygon>& lit) {
  const std::size_t before = lit.size();
  const Polygon whole = part;
  for (const Plane& plane : shadow) {
    auto [front, behind] = split(part, plane, tolerance_m);
    if (behind.empty()) {  // none of it in the shadow: as it was, not in pieces
      lit.resize(before);
      lit.push_back(whole);
      return;
    }
    if (front.size() >= 3) lit.push_back(std::move(front));
    part = std::move(behind);
  }
}

}  // namespace

std::vector<Polygon> visible_parts(const Vec3& x, const Polygon& target,
                                   std::span<const std::uint32_t> blockers,
                                   const Occluders& occluders) {
  // Shadows far thinner than this carry no light; a wall that only touches the target's edge makes
  // none.
  const double tolerance_m = 1e-9 * occluders.extent_m();
  std::vector<Polygon> parts{target}, lit;
  for (const std::uint32_t blocker : blockers) {
    const std::vector<Plane> shadow = shadow_of(x, occluders.polygon(blocker), tolerance_m);
    if (shadow.empty()) continue;
    lit.clear();
    for (Polygon& part : parts) cut_out(std::move(part), shadow, tolerance_m, lit);
    std::swap(parts, lit);
    if (parts.empty()) break;
  }
  return parts;
}

}  // namespace enfilade
