// Drops the pairs of clusters that are proved hidden, many at once where that goes.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/progress.hpp"
#include "clusters/cluster.hpp"
#include "visibility/occlusion.hpp"

namespace enfilade {

/// Pairs between two cells are tried as one, then halved, down to single pairs: most of what a wall
/// hides, it hides together. `progress` is called with shares from `done_before` to 1.
void drop_hidden(std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs,
                 std::span<const Cluster> clusters, const Occlusion& occlusion,
                 const Progress& progress, double done_before);

}  // namespace enfilade
