// Spectral bands that are alike are solved once.
#pragma once

#include <span>

#include "scene/scene.hpp"

namespace enfilade {

/// Leaves one of each set of bands in which all surfaces and lights are alike, as the three of a
/// grey RGB scene, and notes in `band_of` where the others went.
void merge_equal_bands(Scene& scene);

/// Bands of the scene's file.
std::size_t bands_of_file(const Scene& scene);
/// Light in the bands that are solved -> in those of the file.
Spectrum in_bands_of_file(const Scene& scene, std::span<const double> solved);

}  // namespace enfilade
