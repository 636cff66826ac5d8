// Spectral bands that are alike are solved once.
#pragma once

#include <span>

#include "scene/scene.hpp"

namespace enfilade {

/// Leaves one of each set of bands in which all surfaces and lights are alike, as the three of a
/// grey RGB scene; `band_of` then says which band stands for each band of the file.
void merge_equal_bands(Scene& scene);

/// Returns the number of bands of the scene's file.
std::size_t bands_of_file(const Scene& scene);
/// Returns values in the bands that are solved, as values in the bands of the file.
Spectrum in_bands_of_file(const Scene& scene, std::span<const double> solved);

}  // namespace enfilade
