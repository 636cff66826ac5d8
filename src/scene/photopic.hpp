// One value of light from several bands.
#pragma once

#include <span>
#include <string>

#include "scene/scene.hpp"

namespace enfilade {

/// Returns the light of the solved bands `solved` as one value, in the scene's unit. Three bands of
/// the file are red, green and blue, and are weighted as the eye weights them (Rec. ITU-R BT.709:
/// 0.2126, 0.7152, 0.0722); of any other number of bands it is the mean.
double photopic(const Scene& scene, std::span<const double> solved);

/// How photopic() makes one value, for tables: "0.2126 R + 0.7152 G + 0.0722 B", "mean of 5 bands",
/// or empty for one band.
std::string photopic_words(const Scene& scene);

}  // namespace enfilade
