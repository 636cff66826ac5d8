#include "radiosity/seen_factor.hpp"

#include "radiosity/visible_parts.hpp"

namespace enfilade {
namespace {

/// Up to so many are cut away exactly.
constexpr std::size_t most_occluders = 16;

}  // namespace

std::optional<double> seen_factor(const Occluders& occluders, const Vec3& p, const Vec3& n,
                                  std::uint32_t own, std::uint32_t seen, const Polygon& corners) {
  std::vector<std::uint32_t> between;
  if (!occluders.find_between({p}, corners, own, seen, most_occluders, between)) return {};
  VisibleParts parts;
  parts.begin(p, corners, occluders.tolerance_m());
  for (const std::uint32_t occluder : between) {
    if (!parts.hide(occluders.polygon(occluder))) return {};
  }
  return parts.factor(n);
}

}  // namespace enfilade
