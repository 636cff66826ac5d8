#include "gather/extrapolate.hpp"

#include <cmath>

namespace enfilade {
namespace {

/// A leaf whose light has changed by more than this share of itself is not near its rest.
constexpr double most_change = 0.1;

/// Calls take(node, number) for each leaf, with its number among the leaves.
template <class Take>
void for_each_leaf(const PatchForest& patches, Take take) {
  std::size_t number = 0;
  for (std::size_t n = 0; n < patches.size(); ++n) {
    if (patches.node(n).leaf()) take(n, number++);
  }
}

/// The power of an irradiance: of(node, number of the leaf) per band.
template <class Irradiance>
std::vector<double> power_of(const ClusterState& receiver, Irradiance of) {
  const PatchForest& patches = receiver.patches();
  const auto bands = static_cast<std::size_t>(patches.bands());
  std::vector<double> sums(receiver.aggregates().size() * bands, 0.0), power(bands);
  for_each_leaf(patches, [&](std::size_t n, std::size_t number) {
    for (std::size_t b = 0; b < bands; ++b)
      power[b] = patches.node(n).shape.area_m2 * of(n, number, b);
    receiver.aggregates().add(patches, patches.node(n).id, power, sums);
  });
  return sums;
}

}  // namespace

std::vector<double> arriving_power(const ClusterState& receiver) {
  const PatchForest& patches = receiver.patches();
  const auto terms = static_cast<std::size_t>(patches.terms());
  return power_of(receiver, [&](std::size_t n, std::size_t, std::size_t b) {
    return patches.irradiance(n)[b * terms];
  });
}

void extrapolate(ClusterState& receiver, std::span<const double> earlier, double extrapolation) {
  if (earlier.empty()) return;
  PatchForest& patches = receiver.patches();
  const auto bands = static_cast<std::size_t>(patches.bands()),
             terms = static_cast<std::size_t>(patches.terms());
  const std::vector<double> now = arriving_power(receiver);
  const std::vector<double> then =
      power_of(receiver, [&](std::size_t, std::size_t number, std::size_t b) {
        return earlier[(number * bands + b) * terms];
      });
  for_each_leaf(patches, [&](std::size_t n, std::size_t number) {
    const Aggregates::Range range = receiver.aggregates().of(patches, patches.node(n).id);
    for (std::size_t b = 0; b < bands; ++b) {
      double power = 0.0, power_then = 0.0;
      for (std::uint32_t z = range.begin; z < range.end; ++z) {
        power += now[z * bands + b];
        power_then += then[z * bands + b];
      }
      if (!(power > 0.0 && power_then > 0.0)) continue;
      double* const e = patches.irradiance(n).data() + b * terms;
      const double* const before = earlier.data() + (number * bands + b) * terms;
      const auto scaled = [&](std::size_t t) { return power / power_then * before[t]; };
      if (!(std::abs(e[0] - scaled(0)) <= most_change * std::abs(e[0]))) continue;
      for (std::size_t t = 0; t < terms; ++t) e[t] = scaled(t) + extrapolation * (e[t] - scaled(t));
    }
  });
  patches.pull();
}

}  // namespace enfilade
