// What a cell sees through its portals (G_cell, §3.2), asked for cell by cell when a receiver there
// gathers: the coarsest level of visibility. Conservative: light is never shut out.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cells/partition/cell_complex.hpp"
#include "clusters/cluster.hpp"
#include "visibility/portal_search.hpp"

namespace enfilade {

struct SightConfig {
  int max_passes = 0;  ///< VisibilityConfig::max_passes
  /// Doorways that the search from one cell may try. Where walls have hundreds of slits, sequences
  /// through them reach most of the building, and following them all shows little: the cell is then
  /// taken to see every cell that it is connected with.
  std::uint64_t most_doorways = 20000;
};

/// The cells that each cell sees. A cluster lies in one cell, but its polygons may stick out into
/// others by the cells' tolerance; a cluster sees what any of its cells sees.
class CellSights {
 public:
  /// `complex` must outlive it.
  CellSights(const CellComplex& complex, std::span<const Cluster> clusters,
             const SightConfig& config = {});

  /// Returns the cells that some part of the cluster sees, ascending; its own among them.
  std::vector<CellId> seen_by(ClusterId receiver) const;
  /// Returns the cells that the cluster lies in, its own first.
  std::span<const CellId> cells_of(ClusterId cluster) const {
    return {cells_of_.data() + first_[cluster.index()],
            cells_of_.data() + first_[cluster.index() + 1]};
  }
  const DoorwayMap& doorways() const { return doorways_; }
  /// Returns the clusters that lie in more than one cell.
  std::span<const ClusterId> sticking_out() const { return sticking_out_; }
  /// Returns the cells that a cell sees, ascending; itself among them.
  const std::vector<CellId>& seen_from(CellId cell) const;

 private:
  std::vector<CellId> search(CellId cell) const;
  std::vector<CellId> connected_with(CellId cell) const;

  const CellComplex& complex_;
  SightConfig config_;
  DoorwayMap doorways_;
  std::vector<CellId> cells_of_;  ///< of cluster c: from first_[c] to before first_[c + 1]
  std::vector<std::size_t> first_;
  std::vector<ClusterId> sticking_out_;
  mutable std::vector<std::unique_ptr<std::vector<CellId>>> seen_;  ///< by cell, once it is asked
};

}  // namespace enfilade
