// The parts of a prepared run that plans are drawn from.
#pragma once

#include <span>

#include "cells/partition/cell_complex.hpp"
#include "clusters/cluster.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

/// Refers to its parts, which must outlive it.
struct PlannedBuilding {
  const CellComplex& cells;
  std::span<const Cluster> clusters;
  const Occluders& occluders;  ///< made of `clusters`
};

}  // namespace enfilade
