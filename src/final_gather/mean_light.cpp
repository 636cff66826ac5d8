#include "final_gather/mean_light.hpp"

#include <algorithm>

namespace enfilade {
namespace {

/// The mean light that a node reflects, of the largest band.
double largest_reflected(const PatchForest& forest, std::size_t node) {
  const BandValues& exitance = forest.frames()[forest.node(node).id.root].exitance;
  const auto terms = static_cast<std::size_t>(forest.terms());
  double largest = 0.0;
  for (std::size_t b = 0; b < static_cast<std::size_t>(forest.lead_bands()); ++b)
    largest = std::max(largest, forest.radiosity(node)[b * terms] - exitance[b]);
  return largest;
}

}  // namespace

Spectrum mean_irradiance_over(std::span<const ClusterState> clusters) {
  Spectrum mean(clusters.empty() ? 1 : static_cast<std::size_t>(clusters[0].bands()), 0.0);
  double area = 0.0;
  for (const ClusterState& cluster : clusters) {
    const PatchForest& patches = cluster.patches();
    for (std::size_t k = 0; k < patches.polygons(); ++k) {
      area += patches.node(k).shape.area_m2;
      for (std::size_t b = 0; b < mean.size(); ++b) {
        mean[b] += patches.node(k).shape.area_m2 *
                   patches.irradiance(k)[b * static_cast<std::size_t>(patches.terms())];
      }
    }
  }
  for (double& m : mean) m = area > 0.0 ? m / area : 0.0;
  return mean;
}

double mean_link_error_over(std::span<const ClusterState> clusters) {
  double power = 0.0, uncertain = 0.0;
  for (const ClusterState& cluster : clusters) {
    const PatchForest& patches = cluster.patches();
    for (std::size_t n = 0; n < patches.size(); ++n) {
      const PatchNode& node = patches.node(n);
      if (!node.leaf()) continue;
      const double reflected = node.shape.area_m2 * largest_reflected(patches, n);
      power += reflected;
      uncertain += reflected * patches.link_error(n);
    }
  }
  return power > 0.0 ? uncertain / power : 0.0;
}

double mean_radiosity_over(std::span<const ClusterState> clusters) {
  double area = 0.0, power = 0.0;
  for (const ClusterState& cluster : clusters) {
    const PatchForest& patches = cluster.patches();
    for (std::size_t k = 0; k < patches.polygons(); ++k) {
      area += patches.node(k).shape.area_m2;
      power += patches.node(k).shape.area_m2 * largest_radiosity(patches, k);
    }
  }
  return area > 0.0 ? power / area : 0.0;
}

double largest_radiosity(const PatchForest& forest, std::size_t node) {
  const std::span<const double> light = forest.radiosity(node);
  const auto terms = static_cast<std::size_t>(forest.terms());
  const std::size_t lead = terms * static_cast<std::size_t>(forest.lead_bands());
  double largest = 0.0;
  for (std::size_t i = 0; i < lead; i += terms) largest = std::max(largest, light[i]);
  return largest;
}

double darkness(const Spectrum& mean, std::span<const double> light) {
  double times = 1.0;
  for (std::size_t b = 0; b < light.size(); ++b)
    times = std::max(times, mean[b] / std::max(light[b], 1e-9 * mean[b]));
  return times;
}

double far_sides(double patch_error) {
  constexpr double error_of_one_side = 0.01, least = 1.0, most = 4.0;
  return std::clamp(patch_error / error_of_one_side, least, most);
}

}  // namespace enfilade
