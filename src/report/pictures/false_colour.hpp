// False colour: irradiance as colours, with a legend in the scene's unit.
#pragma once

#include <string>

#include "report/drawing/bitmap.hpp"
#include "report/pictures/render.hpp"

namespace enfilade {

struct FalseColourConfig {
  double lowest = 0.0, highest = 0.0;  ///< ends of the scale; both 0 = from the picture
  bool logarithmic = true;
};

/// `unit` is irradiance_label() of the scene: "lx" or "W/m2". The legend stands at the right,
/// inside the picture.
Bitmap false_coloured(const LightImage& image, const std::string& unit,
                      const FalseColourConfig& config = {});

/// Returns the colour of t in [0, 1], dark blue over green and yellow to dark red.
Rgb8 scale_colour(double t);

}  // namespace enfilade
