// The parts of a cluster that the coarse system has an unknown each for (coarse_system.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/byte_stream.hpp"
#include "hierarchy/patch.hpp"

namespace enfilade {

/// A cut through a cluster's hierarchy, the same on every rank whatever patches have been made
/// there: groups, polygons, or parts of polygons, in depth-first order, so that any node reaches
/// into a range of them. One aggregate is the whole cluster.
class Aggregates {
 public:
  struct Range {
    std::uint32_t begin = 0, end = 1;
    std::uint32_t size() const { return end - begin; }
  };

  Aggregates() = default;
  /// The largest node is parted until there are `most` aggregates.
  Aggregates(const PatchForest& forest, std::size_t most);

  std::size_t size() const { return aggregates_.empty() ? 1 : aggregates_.size(); }
  /// The aggregate that a patch lies in, or those that lie in it.
  Range of(const PatchForest& forest, PatchId node) const;
  /// Adds `power` (per band) of a patch to its aggregates in `sums` [aggregate * bands + band], by
  /// area.
  void add(const PatchForest& forest, PatchId patch, std::span<const double> power,
           std::span<double> sums) const;
  /// [aggregate * bands + band]: what of the radiosity is reflected, times area.
  std::vector<double> reflected_power(const PatchForest& forest) const;
  /// Adds these shares [aggregate * bands + band] of the aggregates' irradiance, and what is
  /// reflected of that: as evenly over a polygon's part in a aggregate as its darkest leaf is lit,
  /// so that no leaf gains more than twice its own share and the dark stays dark; the rest, and
  /// what is taken, by each leaf's own light.
  void add_share(PatchForest& forest, std::span<const double> shares) const;

  std::size_t memory_bytes() const {
    return aggregates_.capacity() * sizeof(Aggregate) + of_polygon_.capacity() * sizeof(Range);
  }
  void write(ByteWriter& w) const;
  static Aggregates read(ByteReader& r);

 private:
  struct Aggregate {
    PatchId node;
    double area_m2 = 0.0;
  };
  std::vector<Aggregate> aggregates_;  ///< empty: one, the cluster
  std::vector<Range> of_polygon_;
};

}  // namespace enfilade
