// The factor from a point to a facing disk, from two areas and a distance.
#include "assignment/form_factor_estimate.hpp"

#include <cmath>
#include <numbers>

namespace enfilade {

FormFactorEstimate::FormFactorEstimate(std::span<const Cluster> clusters) {
  for (const Cluster& cluster : clusters) {
    nodes_.push_back({cluster.bounds.center(), std::sqrt(cluster.area_m2)});
  }
}

double FormFactorEstimate::between(std::size_t a, std::size_t b) const {
  if (nodes_.empty()) return 1.0;
  const Vec3 apart = nodes_[b].centre - nodes_[a].centre;
  const double area_m2 = nodes_[a].root_area_m * nodes_[b].root_area_m;
  return area_m2 / (area_m2 + std::numbers::pi * glm::dot(apart, apart));
}

}  // namespace enfilade
