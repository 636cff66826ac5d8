// What plans are drawn from: a prepared run, with or without light.
#pragma once

#include <span>

#include "cells/partition/cell_complex.hpp"
#include "clusters/cluster.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

/// Refers to its parts, which must outlive it.
struct Building {
  const CellComplex& cells;
  std::span<const Cluster> clusters;
  const Occluders& occluders;  ///< made of `clusters`
};

}  // namespace enfilade
