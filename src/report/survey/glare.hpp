// The unified glare rating (UGR) at places, after CIE 117-1995.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "report/survey/room_figures.hpp"

namespace enfilade {

/// An eye and where it looks.
struct GlarePlace {
  std::string name;
  Vec3 p{0.0};
  Vec3 direction{1.0, 0.0, 0.0};  ///< unit vector
};

struct GlareRating {
  GlarePlace place;
  /// UGR = 8 log10(0.25 / Lb * sum of L^2 omega / p^2), of all that emits, with one standard
  /// deviation by the error of Lb. None where the background is dark or no source is seen.
  std::optional<Estimate> ugr;
  double background_cd_m2 = 0.0;  ///< Lb: indirect illuminance at the eye, across the view, by pi
  std::size_t sources = 0;        ///< emitting polygons that are seen before the eye
  double largest_sr = 0.0;        ///< solid angle of the largest; CIE 117 holds from 0.0003 to 0.1
};

/// Returns Guth's position index of a source in direction `source`, seen by an eye that looks along
/// `view` (unit vectors); below the line of sight that of Iwata and Tokura (1997), at most 16.
double position_index(const Vec3& view, const Vec3& source);

/// The scene's light is in lumens. Sources are the emitting polygons, cut into parts that are small
/// to the eye, each with rays that tell how much of it is seen; their luminance is exitance by pi.
/// Point lights have no area and count for nothing. Behind the eye there is no glare.
std::vector<GlareRating> glare_at(const SurveyedScene& scene, std::span<const GlarePlace> places,
                                  double maintenance_factor, const Progress& progress = {});

}  // namespace enfilade
