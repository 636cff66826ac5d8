// The bounds that the iteration starts from.
#include <algorithm>

#include "bounds/iteration/bound_state.hpp"

namespace enfilade {

/// Along a line through panes, each with rho + tau <= 1, comes at most M + (1 - T (1 - rho)) E, T
/// the product of all transmittances and rho the largest of a wall, as the sum over the panes
/// telescopes; without panes T = 1.
/// No radiosity exceeds the largest M + rho D over 1 - the largest rho, D the direct light.
void BoundState::start_with_global_bounds() {
  irradiance_.assign(tree_.size() * scene_.bands, {});
  radiosity_.assign(tree_.size() * scene_.bands, {});
  for (std::size_t band = 0; band < scene_.bands; ++band) {
    double source = 0.0, reflectance = 0.0;
    for (const Receiver& r : receivers_) {
      const BoundPolygon& p = scene_.polygons[tree_[r.node].polygon];
      const double share = panes_.any() ? 1.0 : p.reflectance[band];
      source = std::max(source, p.exitance[band] + share * r.direct[band].at_points.hi);
      if (!p.pane) reflectance = std::max(reflectance, p.reflectance[band]);
    }
    const double most =
        panes_.most_sum() * source / (panes_.passed_by_all(band) * (1.0 - reflectance));
    for (const Receiver& r : receivers_) {
      const double e = most + r.direct[band].at_points.hi;
      irradiance_[r.node * scene_.bands + band] = {{0.0, e}, {0.0, e}, 0.5 * e};
    }
  }
  pull();
}

}  // namespace enfilade
