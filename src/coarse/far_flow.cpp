#include "coarse/far_flow.hpp"

#include <algorithm>

#include "coarse/aggregate_flow.hpp"

namespace enfilade {

/// Sums the clusters below the node; nodes that shoot as one are small, or few. A cluster with
/// several aggregates divides what it reflects evenly among them.
FarUnknowns::Parts FarUnknowns::make(std::uint32_t node) const {
  const BuildingTree& tree = light_.tree();
  const BuildingTree::Node& n = tree.node(node);
  const std::size_t width = bands();
  Parts parts;
  std::vector<double> all(width, 0.0);
  sums_.resize(count() * width, 0.0);
  for (std::uint32_t i = n.begin; i < n.end; ++i) {
    const ClusterId cluster = tree.clusters()[i];
    const std::uint32_t aggregates = unknowns_.aggregates[cluster.index()];
    for (std::size_t b = 0; b < width; ++b) {
      const double power = light_.reflected_power(tree.leaf_of(cluster), b);
      all[b] += power;
      for (std::uint32_t z = 0; z < aggregates; ++z)
        sums_[(unknowns_.first[cluster.index()] + z) * width + b] += power / aggregates;
    }
    for (std::uint32_t z = 0; z < aggregates; ++z)
      parts.unknown.push_back(unknowns_.first[cluster.index()] + z);
  }
  std::sort(parts.unknown.begin(), parts.unknown.end());
  parts.unknown.erase(std::unique(parts.unknown.begin(), parts.unknown.end()), parts.unknown.end());
  for (const std::uint32_t unknown : parts.unknown) {
    for (std::size_t b = 0; b < width; ++b) {
      double& power = sums_[unknown * width + b];
      parts.share.push_back(all[b] > 0.0 ? power / all[b] : 0.0);
      power = 0.0;
    }
  }
  return parts;
}

const FarUnknowns::Parts& FarUnknowns::of(std::uint32_t node) const {
  std::unique_ptr<Parts>& found = parts_[node];
  if (!found) found = std::make_unique<Parts>(make(node));
  return *found;
}

void FarFlow::add(const Link& link, std::span<const float> transport,
                  std::span<const double> power) {
  parts_.push_back({link.shooter.group(), static_cast<std::uint32_t>(power_.size())});
  if (receiving_.size() == 1) {
    power_.insert(power_.end(), power.begin(), power.end());
    return;
  }
  for (const double share : received_shares(receiver_, receiving_, link, transport)) {
    for (const double p : power) power_.push_back(share * p);
  }
}

CoarseRow::Far FarFlow::entries(const FarUnknowns& unknowns) {
  const std::size_t bands = unknowns.bands(), width = receiving_.size() * bands;
  std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
    return a.node != b.node ? a.node < b.node : a.first < b.first;
  });
  std::vector<double> sums(unknowns.count() * width, 0.0), flow(width);
  for (std::size_t i = 0; i < parts_.size();) {
    const std::uint32_t node = parts_[i].node;
    std::fill(flow.begin(), flow.end(), 0.0);
    for (; i < parts_.size() && parts_[i].node == node; ++i) {
      for (std::size_t k = 0; k < width; ++k) flow[k] += power_[parts_[i].first + k];
    }
    const FarUnknowns::Parts& shares = unknowns.of(node);
    for (std::size_t u = 0; u < shares.unknown.size(); ++u) {
      double* sum = sums.data() + shares.unknown[u] * width;
      const double* share = shares.share.data() + u * bands;
      for (std::size_t k = 0; k < width; k += bands)
        for (std::size_t b = 0; b < bands; ++b) sum[k + b] += share[b] * flow[k + b];
    }
  }
  CoarseRow::Far far;
  for (std::size_t u = 0; u < unknowns.count(); ++u) {
    const auto first = sums.begin() + static_cast<std::ptrdiff_t>(u * width);
    const auto end = first + static_cast<std::ptrdiff_t>(width);
    if (std::all_of(first, end, [](double f) { return f == 0.0; })) continue;
    far.columns.push_back(static_cast<std::uint32_t>(u));
    far.flows.insert(far.flows.end(), first, end);
  }
  return far;
}

}  // namespace enfilade
