// The methods by name; round robin; empty parts are filled.
#include "assignment/assignment.hpp"

#include <algorithm>
#include <array>

#include "assignment/greedy_groups.hpp"
#include "assignment/kmeans.hpp"
#include "assignment/metis_partition.hpp"
#include "base/error.hpp"

namespace enfilade {

namespace {

constexpr std::array<const char*, 4> names{"kmeans", "metis", "greedy", "round-robin"};

std::vector<Rank> round_robin(std::size_t nodes, int parts) {
  std::vector<Rank> owner(nodes);
  for (std::size_t v = 0; v < nodes; ++v) {
    owner[v] = Rank{static_cast<int>(v % static_cast<std::size_t>(parts))};
  }
  return owner;
}

/// Number of neighbours of `node` that have its owner.
std::size_t ties(const ClusterGraph& graph, const std::vector<Rank>& owner, std::size_t node) {
  const auto row = graph.neighbours(node);
  return static_cast<std::size_t>(std::count_if(
      row.begin(), row.end(), [&](std::uint32_t to) { return owner[to] == owner[node]; }));
}

/// Every empty part takes, of the largest part's nodes, the one with the fewest neighbours there.
void fill_empty_parts(const ClusterGraph& graph, std::vector<Rank>& owner, int parts) {
  std::vector<std::size_t> size(static_cast<std::size_t>(parts), 0);
  for (Rank r : owner) ++size[static_cast<std::size_t>(r.value)];
  for (std::size_t empty = 0; empty < size.size(); ++empty) {
    if (size[empty] > 0) continue;
    const auto largest = std::max_element(size.begin(), size.end());
    const Rank donor{static_cast<int>(largest - size.begin())};
    std::size_t best = owner.size(), fewest = owner.size();
    for (std::size_t v = 0; v < owner.size(); ++v) {
      if (owner[v] != donor) continue;
      const std::size_t n = ties(graph, owner, v);
      if (n < fewest) fewest = n, best = v;
    }
    owner[best] = Rank{static_cast<int>(empty)};
    --*largest;
    ++size[empty];
  }
}

}  // namespace

std::span<const char* const> assignment_names() { return names; }

const char* name_of(AssignmentMethod method) { return names[static_cast<std::size_t>(method)]; }

AssignmentMethod assignment_method(const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw InputError("--assignment", "'" + name + "'", "no assignment has this name",
                     "use kmeans, metis, greedy or round-robin");
  }
  return static_cast<AssignmentMethod>(found - names.begin());
}

std::vector<Rank> assign(const ClusterGraph& graph, const FormFactorEstimate& weights,
                         const AssignmentConfig& config) {
  ENFILADE_CHECK(config.parts >= 1, std::to_string(config.parts));
  ENFILADE_CHECK(weights.size() == 0 || weights.size() == graph.size(),
                 std::to_string(weights.size()));
  if (config.parts == 1) return std::vector<Rank>(graph.size(), Rank{0});
  // No more clusters than ranks: one each.
  if (graph.size() <= static_cast<std::size_t>(config.parts)) {
    return round_robin(graph.size(), config.parts);
  }
  std::vector<Rank> owner;
  switch (config.method) {
    case AssignmentMethod::kmeans:
      owner = kmeans_groups(graph, config);
      break;
    case AssignmentMethod::metis:
      owner = metis_parts(graph, config);
      break;
    case AssignmentMethod::greedy:
      owner = greedy_groups(graph, weights, config.parts);
      break;
    case AssignmentMethod::round_robin:
      owner = round_robin(graph.size(), config.parts);
      break;
  }
  fill_empty_parts(graph, owner, config.parts);
  return owner;
}

std::vector<Rank> assign_clusters(const ClusterGraph& graph, std::span<const Cluster> clusters,
                                  const AssignmentConfig& config) {
  return assign(graph, FormFactorEstimate(clusters), config);
}

}  // namespace enfilade
