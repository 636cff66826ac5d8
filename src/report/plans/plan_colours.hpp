// Colours that tell ranks and cells apart.
#pragma once

#include <string>
#include <vector>

#include "cells/partition/cell_complex.hpp"
#include "report/drawing/bitmap.hpp"

namespace enfilade {

/// Of a rank: strong, well apart for neighbouring numbers.
Rgb8 rank_rgb(int rank);
/// The same as CSS.
std::string rank_colour(int rank);

/// Of each cell: light, so that black words stand out; rooms that share a portal differ, and
/// outside and the insides of solids have colours of their own.
std::vector<Rgb8> cell_colours(const CellComplex& complex);

/// Some of `colour`, the rest white.
Rgb8 tint(Rgb8 colour, double share);

namespace plan_ink {
inline constexpr Rgb8 black{20, 20, 20}, soft{110, 110, 110}, faint{190, 190, 190};
inline constexpr Rgb8 outside{232, 240, 247}, solid{178, 174, 168}, unseen{236, 235, 232};
inline constexpr Rgb8 doorway{214, 48, 31}, to_outside{30, 90, 214}, into_solid{128, 96, 150};
inline constexpr Rgb8 leak{200, 0, 160};
inline constexpr Rgb8 chosen{255, 179, 0}, seen{255, 232, 163};
}  // namespace plan_ink

}  // namespace enfilade
