// Intensity distributions within scene files.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "photometry/intensity_distribution.hpp"
#include "photometry/luminous_opening.hpp"

namespace enfilade {

/// A distribution with the opening that its light comes from.
struct InlineDistribution {
  std::shared_ptr<const IntensityDistribution> distribution;
  LuminousOpening opening;
};

/// Reads {"type": "C", "planes": [...], "angles": [...], "candela": [[...], ...], "opening":
/// {"shape": "rectangle", "size": [x, y, z]}}: degrees, candela, metres; a list of candela for each
/// plane. `type` and `opening` may be missing. Throws InputError that names `where` in `file`.
InlineDistribution distribution_from_json(const nlohmann::json& value, const std::string& file,
                                          const std::string& where);
nlohmann::ordered_json to_json(const InlineDistribution& distribution);

}  // namespace enfilade
