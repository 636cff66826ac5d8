// Which polygons lie in one plane: light that is gathered on one of them counts for the others.
#pragma once

#include <cstdint>
#include <vector>

#include "report/pictures/solved_scene.hpp"

namespace enfilade {

/// Returns a number for each polygon of `solved.occluders`; polygons with the same number face the
/// same way and lie in one plane, to within `tolerance_m`.
std::vector<std::uint32_t> plane_numbers(const SolvedScene& solved, double tolerance_m);

}  // namespace enfilade
