// View factors in the forms that other programs read.
#pragma once

#include <string>

#include "view_factors/view_factors.hpp"

namespace enfilade {

/// A line a pair: from, to, view_factor, error, area_from_m2, area_to_m2, row_sum_before, closed.
std::string view_factors_csv(const ViewFactors& factors);

/// An IDF object of EnergyPlus, ZoneProperty:UserViewFactors:BySurfaceName, for the enclosure
/// (zone) `zone`. What these names may not hold (commas, semicolons, exclamation marks) becomes a
/// blank.
std::string view_factors_idf(const ViewFactors& factors, const std::string& zone);

/// A block of a MOOSE input file: the boundaries and view factors of a
/// ConstantViewFactorSurfaceRadiation user object. Blanks and quotes in names become _.
std::string view_factors_moose(const ViewFactors& factors);

}  // namespace enfilade
