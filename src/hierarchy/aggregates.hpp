// The aggregates of a cluster: the parts that have one unknown each in the coarse system of the
// two-level method (coarse/coarse_system.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hierarchy/patch_forest.hpp"

namespace enfilade {

/// A cut through a cluster's hierarchy, the same on every rank whatever patches have been made
/// there: groups, polygons, or parts of polygons, in depth-first order, so that the aggregates
/// under any node of the hierarchy are consecutive. One aggregate is the whole cluster.
class Aggregates {
 public:
  /// Consecutive aggregates, begin .. end - 1.
  struct Range {
    std::uint32_t begin = 0, end = 1;
    std::uint32_t size() const { return end - begin; }
  };

  /// One aggregate.
  Aggregates() = default;
  /// Splits the largest node (by area) until there are `most` aggregates.
  Aggregates(const PatchForest& forest, std::size_t most);

  std::size_t size() const { return aggregates_.empty() ? 1 : aggregates_.size(); }
  /// Returns the aggregate that contains the node, or the aggregates that the node contains.
  Range of(const PatchForest& forest, PatchId node) const;
  /// Adds a patch's `power` (per band) to its aggregates in `sums` [aggregate * bands + band],
  /// divided among several by area.
  void add(const PatchForest& forest, PatchId patch, std::span<const double> power,
           std::span<double> sums) const;
  /// Returns area times reflected radiosity (radiosity - exitance) of each aggregate, not below
  /// zero, [aggregate * bands + band].
  std::vector<double> reflected_power(const PatchForest& forest) const;
  /// Adds the shares [aggregate * bands + band] of the aggregates' irradiance to the leaves, and
  /// the light that they reflect of it. An addition is distributed over the leaves of a polygon
  /// within an aggregate: a uniform part, as large as the least lit of these leaves allows, and the
  /// rest in proportion to each leaf's irradiance. So no leaf gains more than twice its
  /// proportional share. Dark leaves stay dark. Negative additions are distributed in proportion
  /// only.
  void add_share(PatchForest& forest, std::span<const double> shares) const;

  std::size_t memory_bytes() const {
    return aggregates_.capacity() * sizeof(Aggregate) + of_polygon_.capacity() * sizeof(Range);
  }

 private:
  friend class ClusterCodec;
  struct Aggregate {
    PatchId node;
    double area_m2 = 0.0;
  };
  double mean_share(Range range, std::span<const double> shares, std::size_t band,
                    std::size_t bands) const;

  std::vector<Aggregate> aggregates_;  ///< empty: one, the cluster
  std::vector<Range> of_polygon_;
};

}  // namespace enfilade
