// One value of light from several bands, for tables.
#pragma once

#include <span>
#include <string>

#include "scene/scene.hpp"

namespace enfilade {

/// Returns light in the solved bands as one value, in the scene's unit: lx where that is lumens.
/// The bands are weighted as photopic() of scene/photopic.hpp weights them.
double one_value(const Scene& scene, std::span<const double> solved);

/// How one_value() weights the bands: "0.2126 R + 0.7152 G + 0.0722 B", "mean of 5 bands", or empty
/// for one band.
std::string weights_of(const Scene& scene);

}  // namespace enfilade
