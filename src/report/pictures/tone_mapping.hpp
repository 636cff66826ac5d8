// From light to display values: Reinhard's photographic operator, or a linear scale.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "report/drawing/bitmap.hpp"
#include "report/pictures/render.hpp"

namespace enfilade {

struct ToneConfig {
  enum class Curve { reinhard, linear } curve = Curve::reinhard;
  double key = 0.18;      ///< display value of the log-average luminance (Reinhard 2002)
  double exposure = 0.0;  ///< > 0: factor on the light; 0 = found from the light in the picture
};

/// Maps linear light to [0, 1] display light (Reinhard, Stark, Shirley, Ferwerda 2002, equations 1
/// to 4).
class ToneMap {
 public:
  /// Exposure and white are found from `luminances`, pairs of a luminance and its weight.
  ToneMap(std::vector<std::pair<double, double>> weighted_luminances, const ToneConfig& config);
  std::array<double, 3> operator()(const std::array<double, 3>& rgb) const;
  double exposure() const { return exposure_; }
  /// Light times exposure() that is shown as white.
  double white() const { return white_; }

 private:
  ToneConfig::Curve curve_;
  double exposure_ = 1.0, white_ = 1.0;
};

/// Returns the Rec. 709 luminance.
double luminance(const std::array<double, 3>& rgb);
/// sRGB transfer curve, 0..1 to 0..255.
std::uint8_t srgb8(double linear);

Bitmap tone_mapped(const LightImage& image, const ToneConfig& config = {});

}  // namespace enfilade
