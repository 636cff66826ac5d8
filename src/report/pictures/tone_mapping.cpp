#include "report/pictures/tone_mapping.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {

namespace {

/// Luminance below which `share` of the weight lies; `sorted` rises.
double quantile(const std::vector<std::pair<double, double>>& sorted, double share) {
  double total = 0.0, below = 0.0;
  for (const auto& [value, weight] : sorted) total += weight;
  for (const auto& [value, weight] : sorted) {
    below += weight;
    if (below >= share * total) return value;
  }
  return 0.0;
}

/// Equation 1, exp of the mean log, over luminances of at least a thousandth of the median: dark
/// insides of cupboards and walls must not raise the exposure of the rooms.
double log_average(const std::vector<std::pair<double, double>>& sorted) {
  const double floor = 1e-3 * quantile(sorted, 0.5);
  double sum = 0.0, total = 0.0;
  for (const auto& [value, weight] : sorted) {
    if (value <= floor) continue;
    sum += weight * std::log(value);
    total += weight;
  }
  return total > 0.0 ? std::exp(sum / total) : 0.0;
}

}  // namespace

ToneMap::ToneMap(std::vector<std::pair<double, double>> luminances, const ToneConfig& config)
    : curve_(config.curve) {
  std::erase_if(luminances, [](const auto& l) { return !(l.first > 0.0) || !(l.second > 0.0); });
  std::sort(luminances.begin(), luminances.end());
  const double middle = log_average(luminances);
  if (config.exposure > 0.0) {
    exposure_ = config.exposure;
  } else if (middle > 0.0) {
    exposure_ = config.key / middle;
  }
  // The smallest light that is shown as white: lamps beyond the brightest 0.2 % may burn out.
  white_ = std::max(1.0, exposure_ * quantile(luminances, 0.998));
}

std::array<double, 3> ToneMap::operator()(const std::array<double, 3>& rgb) const {
  const double light = exposure_ * luminance(rgb);
  double scale = exposure_;
  if (curve_ == ToneConfig::Curve::reinhard) {
    scale *= (1.0 + light / (white_ * white_)) / (1.0 + light);
  }
  std::array<double, 3> shown{};
  for (std::size_t i = 0; i < 3; ++i) shown[i] = std::clamp(scale * rgb[i], 0.0, 1.0);
  return shown;
}

double luminance(const std::array<double, 3>& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

std::uint8_t srgb8(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double v = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * v));
}

Bitmap tone_mapped(const LightImage& image, const ToneConfig& config) {
  // Display-linear colours of what no sample met, and of solids that the cut goes through.
  constexpr std::array<double, 3> background{0.80, 0.83, 0.87}, section{0.035, 0.04, 0.05};
  std::vector<std::pair<double, double>> luminances;
  const auto light_of = [](const LightImage::Pixel& p) {
    const double lit = p.cover + p.sky, n = lit > 0.0 ? 1.0 / lit : 0.0;
    return std::array<double, 3>{n * p.radiosity[0], n * p.radiosity[1], n * p.radiosity[2]};
  };
  // The exposure is for what stands in the picture: a sky behind windows may burn out. Where it
  // shows the sky alone, it is for the sky.
  const bool things = std::ranges::any_of(
      image.pixels, [](const auto& p) { return p.cover > 0.0f && p.sky == 0.0f; });
  for (const auto& p : image.pixels) {
    const double weight = !things ? p.cover + p.sky : p.sky > 0.0f ? 0.0f : p.cover;
    luminances.emplace_back(luminance(light_of(p)), weight);
  }
  const ToneMap map(std::move(luminances), config);
  Bitmap bitmap(image.width, image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const auto& p = image.pixels[i];
    const std::array<double, 3> shown = map(light_of(p));
    const double empty = std::max(0.0, 1.0 - p.cover - p.sky - p.section);
    for (std::size_t c = 0; c < 3; ++c) {
      bitmap.pixels[i][c] =
          srgb8((p.cover + p.sky) * shown[c] + p.section * section[c] + empty * background[c]);
    }
  }
  return bitmap;
}

}  // namespace enfilade
