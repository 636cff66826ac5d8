// Plans: a level section through cells and walls, coloured by rank.
#pragma once

#include <span>
#include <string>

#include "base/ids.hpp"
#include "report/solved_scene.hpp"

namespace enfilade {

struct FloorPlan {
  std::string title;  ///< "storey 1, cut at 1.20 m"
  std::string svg;
};

/// One plan a storey, cut 1.2 m above its floor: walls as lines, each cell in the colour of the
/// rank that has most of its surface, a dot for each cluster in its own rank's colour. `owner`
/// empty: cells by kind.
std::vector<FloorPlan> floor_plans(const SolvedScene& solved, std::span<const Rank> owner);

/// CSS colour of a rank, well apart for neighbouring ranks.
std::string rank_colour(int rank);

}  // namespace enfilade
