#include "coarse/coarse_unknowns.hpp"

#include <string>

#include "base/error.hpp"

namespace enfilade {

namespace {

/// Clusters are listed by cell. Each unknown gets a run of at most ceil(clusters / most) of them; a
/// run that is at least half full also ends where a cell ends.
CoarseUnknowns shared_unknowns(std::span<const Cluster> clusters, std::size_t most) {
  CoarseUnknowns unknowns{std::vector<std::uint32_t>(clusters.size()),
                          std::vector<std::uint32_t>(clusters.size(), 1), 1};
  const std::size_t share = (clusters.size() + most - 1) / most;
  std::size_t in_group = 0;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const bool other_cell =
        i > 0 && clusters[i].cell != clusters[i - 1].cell && 2 * in_group >= share;
    if (in_group >= share || other_cell) {
      ++unknowns.count;
      in_group = 0;
    }
    unknowns.first[i] = static_cast<std::uint32_t>(unknowns.count - 1);
    ++in_group;
  }
  return unknowns;
}

}  // namespace

std::span<const double> CoarseUnknowns::of(ClusterId cluster, std::span<const double> numbers,
                                           std::size_t bands) const {
  const std::size_t begin = first[cluster.index()] * bands,
                    size = aggregates[cluster.index()] * bands;
  ENFILADE_CHECK(begin + size <= numbers.size(), std::to_string(begin));
  return numbers.subspan(begin, size);
}

bool CoarseUnknowns::complete(std::size_t clusters, std::size_t numbers) {
  if (first.size() != clusters || aggregates.size() != clusters) return false;
  count = 0;
  for (std::size_t i = 0; i < clusters; ++i) {
    const bool shares = i > 0 && aggregates[i] == 1 && first[i] + 1 == count;
    if (aggregates[i] < 1 || !(shares || first[i] == count)) return false;
    count = std::size_t{first[i]} + aggregates[i];
  }
  return count > 0 && numbers % count == 0;
}

CoarseUnknowns coarse_unknowns(std::span<const Cluster> clusters, std::size_t least,
                               std::size_t most) {
  if (clusters.size() > most) return shared_unknowns(clusters, most);
  double area_m2 = 0.0;
  for (const Cluster& cluster : clusters) area_m2 += cluster.area_m2;
  const double more =
      area_m2 > 0.0 && clusters.size() < least ? static_cast<double>(least - clusters.size()) : 0.0;
  CoarseUnknowns unknowns;
  for (const Cluster& cluster : clusters) {
    unknowns.first.push_back(static_cast<std::uint32_t>(unknowns.count));
    unknowns.aggregates.push_back(
        1 + static_cast<std::uint32_t>(more > 0.0 ? more * cluster.area_m2 / area_m2 : 0.0));
    unknowns.count += unknowns.aggregates.back();
  }
  return unknowns;
}

}  // namespace enfilade
