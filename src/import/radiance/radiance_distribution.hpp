// Light whose distribution is data: what ies2rad makes of a photometric file.
#pragma once

#include <optional>

#include "import/intake/model_files.hpp"
#include "import/radiance/radiance_primitive.hpp"

namespace enfilade {

/// Returns the exitance of a surface per unit of radiance of its light, in W/m2 per W/(sr m2): of a
/// plane without a distribution it is pi. `pattern` is a brightdata that corrects for the shape of
/// the source (flatcorr, boxcorr, cylcorr, corr of source.cal). None where it is another pattern.
/// Throws InputError where its data cannot be read.
std::optional<double> radiance_distribution(const RadiancePrimitive& pattern, ModelFiles& files);

}  // namespace enfilade
