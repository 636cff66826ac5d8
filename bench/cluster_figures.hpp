// What a cluster weighs in a partition: bytes to load it, work to gather for it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "run/prepare.hpp"

namespace enfilade::bench {

/// One figure a cluster.
struct ClusterFigures {
  std::vector<std::uint64_t> bytes;  ///< that another rank loads to see it: geometry and patches
  std::vector<double> work;          ///< of one gather for it, in arbitrary units
  bool solved = false;               ///< where the figures come from, see below
};

/// Of a RUN that was solved: the sizes of the committed files, and the links that the gather goes
/// over. Of one that is prepared only: the sizes that the files have before the first iteration
/// (linear basis), and the pairs of a polygon of the cluster with one that the cluster may see.
ClusterFigures cluster_figures(const std::string& run_directory, const Prepared& prepared);

}  // namespace enfilade::bench
