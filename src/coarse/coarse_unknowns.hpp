// Which unknowns of the coarse system belong to which cluster.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.hpp"
#include "clusters/cluster.hpp"

namespace enfilade {

/// The unknowns that the clusters have, numbered in the clusters' order.
struct CoarseUnknowns {
  std::vector<std::uint32_t> first;       ///< by cluster: its first unknown
  std::vector<std::uint32_t> aggregates;  ///< by cluster: the number of its unknowns, at most
  std::size_t count = 0;                  ///< of all clusters

  /// True where at least one cluster has several unknowns.
  bool aggregated() const { return count > first.size(); }
  /// Sets `count`. Returns false where `first` and `aggregates` do not describe the unknowns of
  /// `clusters` clusters in order, or where `numbers` is not a multiple of their count.
  bool complete(std::size_t clusters, std::size_t numbers);
  /// Returns the part of `numbers` [unknown * bands + band] that belongs to `cluster`.
  std::span<const double> of(ClusterId cluster, std::span<const double> numbers,
                             std::size_t bands) const;
};

/// Below `least` clusters, large clusters have several unknowns, by area, up to `least` in all:
/// along a corridor light spreads slowly as well. Above `most` clusters, neighbours in the list
/// share an unknown, those of one cell first; there are then fewer than 2 * `most` unknowns, which
/// bounds the cost of the solve (sparse_solve.hpp).
CoarseUnknowns coarse_unknowns(std::span<const Cluster> clusters, std::size_t least = 128,
                               std::size_t most = 512);

}  // namespace enfilade
