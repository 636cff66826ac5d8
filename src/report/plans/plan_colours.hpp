// Colours that distinguish ranks and cells.
#pragma once

#include <string>
#include <vector>

#include "cells/partition/cell_complex.hpp"
#include "report/drawing/bitmap.hpp"

namespace enfilade {

/// Returns a strong colour for a rank; neighbouring ranks get clearly different ones.
Rgb8 rank_rgb(int rank);
/// rank_rgb() as CSS, "#rrggbb".
std::string rank_colour(int rank);

/// Returns a light colour for each cell, on which black words can be read. Rooms that share a
/// portal have different colours; outside and solids have fixed ones.
std::vector<Rgb8> cell_colours(const CellComplex& complex);

/// `share` of `colour`, the rest white.
Rgb8 tint(Rgb8 colour, double share);

namespace plan_ink {
inline constexpr Rgb8 black{20, 20, 20}, soft{110, 110, 110}, faint{190, 190, 190};
inline constexpr Rgb8 outside{232, 240, 247}, solid{178, 174, 168}, unseen{236, 235, 232};
inline constexpr Rgb8 doorway{214, 48, 31}, to_outside{30, 90, 214}, into_solid{128, 96, 150};
inline constexpr Rgb8 leak{200, 0, 160};
inline constexpr Rgb8 chosen{255, 179, 0}, seen{255, 232, 163};
}  // namespace plan_ink

}  // namespace enfilade
