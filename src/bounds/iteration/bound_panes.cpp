#include "bounds/iteration/bound_panes.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace enfilade {

BoundPanes::BoundPanes(const BoundScene& scene) : scene_(scene) {
  bool any = false;
  const auto zero = [](double x) { return x <= 0.0; };
  for (const BoundPolygon& p : scene.polygons) {
    const bool dark =
        p.pane && std::ranges::all_of(p.reflectance, zero) && std::ranges::all_of(p.exitance, zero);
    flags_.push_back(p.pane ? 1 : 0);
    dark_.push_back(dark ? 1 : 0);
    if (p.pane && !dark) most_sum_ += 1.0;
    any |= p.pane;
  }
  if (!any) flags_.clear();
}

double BoundPanes::passed_by_all(std::size_t band) const {
  constexpr double least_passed = 1e-9;
  double passed = 1.0;
  for (const BoundPolygon& p : scene_.polygons) {
    if (!p.transmittance.empty()) passed *= p.transmittance[band];
  }
  if (passed < least_passed) {
    throw InputError("scene", "surfaces", "so many panes that no bound follows from them",
                     "leave panes out, or raise their transmittance");
  }
  return passed;
}

}  // namespace enfilade
