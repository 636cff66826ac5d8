#include "report/pictures/tone_mapping.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace enfilade {

namespace {

/// Pixels of a picture that its exposure is found from.
constexpr std::size_t most_for_exposure = 50000;

/// The sRGB curve (IEC 61966-2-1) backwards.
double linear_of(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

/// The linear values at which the byte steps up to 1, 2... 255: a search takes less than a power.
std::array<double, 255> srgb_steps() {
  std::array<double, 255> steps{};
  for (std::size_t i = 0; i < steps.size(); ++i)
    steps[i] = linear_of((static_cast<double>(i) + 0.5) / 255.0);
  return steps;
}

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
  static const std::array<double, 255> steps = srgb_steps();
  return static_cast<std::uint8_t>(std::ranges::upper_bound(steps, linear) - steps.begin());
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
  // The exposure is no better for all pixels of a large picture than for some of them, from all
  // columns; where none of these shows a thing, it is for all.
  std::size_t stride = std::max<std::size_t>(1, image.pixels.size() / most_for_exposure);
  while (std::gcd(stride, static_cast<std::size_t>(image.width)) != 1) ++stride;
  for (double found = 0.0; found <= 0.0; stride = 1) {
    luminances.clear();
    for (std::size_t i = 0; i < image.pixels.size(); i += stride) {
      const LightImage::Pixel& p = image.pixels[i];
      const double weight = !things ? p.cover + p.sky : p.sky > 0.0f ? 0.0f : p.cover;
      found += weight;
      luminances.emplace_back(luminance(light_of(p)), weight);
    }
    if (stride == 1) break;
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
