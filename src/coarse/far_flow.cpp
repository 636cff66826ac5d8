#include "coarse/far_flow.hpp"

#include <algorithm>

#include "coarse/aggregate_flow.hpp"

namespace enfilade {

FarUnknowns::Powers FarUnknowns::of_cluster(ClusterId cluster, std::uint32_t leaf) const {
  const std::uint32_t aggregates = unknowns_.aggregates[cluster.index()];
  Powers powers;
  for (std::uint32_t z = 0; z < aggregates; ++z) {
    std::vector<double>& power = powers[unknowns_.first[cluster.index()] + z];
    for (std::size_t b = 0; b < bands(); ++b) {
      power.push_back(light_.reflected_power(leaf, b) / aggregates);
    }
  }
  return powers;
}

/// Sums the clusters below the node; nodes that shoot as one are small, or few.
FarUnknowns::Parts FarUnknowns::make(std::uint32_t node) const {
  const BuildingTree& tree = light_.tree();
  const BuildingTree::Node& n = tree.node(node);
  Powers powers;
  std::vector<double> all(bands(), 0.0);
  for (std::uint32_t i = n.begin; i < n.end; ++i) {
    const ClusterId cluster = tree.clusters()[i];
    for (const auto& [unknown, power] : of_cluster(cluster, tree.leaf_of(cluster))) {
      std::vector<double>& sum = powers[unknown];
      sum.resize(bands(), 0.0);
      for (std::size_t b = 0; b < bands(); ++b) {
        sum[b] += power[b];
        all[b] += power[b];
      }
    }
  }
  Parts parts;
  for (const auto& [unknown, power] : powers) {
    parts.unknown.push_back(unknown);
    for (std::size_t b = 0; b < bands(); ++b) {
      parts.share.push_back(all[b] > 0.0 ? power[b] / all[b] : 0.0);
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

std::vector<CoarseRow::FarEntry> FarFlow::entries(const FarUnknowns& unknowns) {
  const std::size_t bands = unknowns.bands(), width = receiving_.size() * bands;
  std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
    return a.node != b.node ? a.node < b.node : a.first < b.first;
  });
  /// What one node sends to the receiver, and the part of it that is one unknown's.
  struct Sent {
    std::uint32_t unknown;
    const double* share;  // per band
    std::size_t flow;     // first of the node's numbers in flows
  };
  std::vector<Sent> sent;
  std::vector<double> flows;
  for (std::size_t i = 0; i < parts_.size();) {
    const std::uint32_t node = parts_[i].node;
    const std::size_t flow = flows.size();
    flows.resize(flow + width, 0.0);
    for (; i < parts_.size() && parts_[i].node == node; ++i) {
      for (std::size_t k = 0; k < width; ++k) flows[flow + k] += power_[parts_[i].first + k];
    }
    const FarUnknowns::Parts& shares = unknowns.of(node);
    for (std::size_t u = 0; u < shares.unknown.size(); ++u)
      sent.push_back({shares.unknown[u], shares.share.data() + u * bands, flow});
  }
  std::stable_sort(sent.begin(), sent.end(),
                   [](const Sent& a, const Sent& b) { return a.unknown < b.unknown; });
  std::vector<CoarseRow::FarEntry> entries;
  for (const Sent& s : sent) {
    if (entries.empty() || entries.back().column != s.unknown)
      entries.push_back({s.unknown, std::vector<double>(width, 0.0)});
    std::vector<double>& sum = entries.back().flow;
    for (std::size_t k = 0; k < width; ++k) sum[k] += s.share[k % bands] * flows[s.flow + k];
  }
  std::erase_if(entries, [](const CoarseRow::FarEntry& entry) {
    return std::all_of(entry.flow.begin(), entry.flow.end(), [](double f) { return f == 0.0; });
  });
  return entries;
}

}  // namespace enfilade
