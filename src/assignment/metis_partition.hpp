// G_val cut by METIS (Karypis and Kumar 1998): fewest cut edges between parts of equal size.
#pragma once

#include <vector>

#include "assignment/assignment.hpp"

namespace enfilade {

/// Needs 1 <= parts <= nodes. A part may come out empty. Throws RunError for more edges than
/// METIS's index type counts.
std::vector<Rank> metis_parts(const ClusterGraph& graph, const AssignmentConfig& config);

}  // namespace enfilade
