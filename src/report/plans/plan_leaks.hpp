// Leaks of a building, drawn on its plans.
#pragma once

#include <span>

#include "cells/rooms/leaks.hpp"
#include "report/plans/floor_plan.hpp"

namespace enfilade {

/// Draws the leaks whose ways begin in the plan's storey: a line from inside to the open, its
/// beginning marked "leak".
void draw_leaks(FloorPlan& plan, const std::vector<Storey>& storeys, std::span<const Leak> leaks);

}  // namespace enfilade
