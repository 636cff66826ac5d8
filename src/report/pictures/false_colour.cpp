#include "report/pictures/false_colour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace enfilade {

namespace {

constexpr Rgb8 nothing{228, 231, 235}, ink{25, 28, 33}, paper{250, 250, 250}, solid{60, 64, 70};

struct Scale {
  double lowest, highest;
  bool logarithmic;
  double position(double value) const {
    const double t = logarithmic
                         ? std::log(std::max(value, lowest) / lowest) / std::log(highest / lowest)
                         : (value - lowest) / (highest - lowest);
    return std::clamp(t, 0.0, 1.0);
  }
};

/// Largest or smallest of 1, 2, 5 times a power of ten on the given side of x.
double round_125(double x, bool up) {
  const double decade = std::pow(10.0, std::floor(std::log10(x)));
  const double steps[] = {1, 2, 5, 10};
  double best = decade;
  for (double s : steps) {
    if (up && s * decade >= x * (1 - 1e-9)) return s * decade;
    if (!up && s * decade <= x * (1 + 1e-9)) best = s * decade;
  }
  return best;
}

/// Between the 2 % darkest and the 0.5 % brightest of the picture, at most four decades.
Scale scale_for(const LightImage& image, const FalseColourConfig& config) {
  if (config.highest > 0.0) {
    const bool logarithmic = config.logarithmic && config.lowest > 0.0;
    return {config.lowest, config.highest, logarithmic};
  }
  std::vector<double> values;
  for (const auto& p : image.pixels) {
    if (p.cover > 0.5f && p.irradiance > 0.0f) values.push_back(p.irradiance / p.cover);
  }
  if (values.empty()) return {0.1, 1.0, config.logarithmic};
  std::sort(values.begin(), values.end());
  const double n = static_cast<double>(values.size() - 1);
  const double top = round_125(values[static_cast<std::size_t>(0.995 * n)], true);
  if (!config.logarithmic) return {0.0, top, false};
  const double low = std::max(values[static_cast<std::size_t>(0.02 * n)], 1e-4 * top);
  return {std::min(round_125(low, false), 0.1 * top), top, true};
}

std::vector<double> ticks(const Scale& scale) {
  std::vector<double> at;
  if (scale.logarithmic) {
    const bool dense = scale.highest / scale.lowest < 5e3;
    for (double v = round_125(scale.lowest, true); v <= scale.highest * (1 + 1e-9);
         v = dense ? round_125(v * 1.5, true) : v * 10.0) {
      at.push_back(v);
    }
    return at;
  }
  const double step = round_125((scale.highest - scale.lowest) / 8.0, true);
  for (double v = std::ceil(scale.lowest / step) * step; v <= scale.highest * (1 + 1e-9);
       v += step) {
    at.push_back(v);
  }
  return at;
}

void draw_legend(Bitmap& bitmap, const Scale& scale, const std::string& unit) {
  const int size = bitmap.height >= 400 ? 2 : 1, line = 10 * size, pad = 6 * size;
  std::vector<std::string> labels;
  int widest = text_width(unit, size);
  for (double v : ticks(scale)) {
    labels.push_back(fmt::format("{:g}", v));
    widest = std::max(widest, text_width(labels.back(), size));
  }
  const int bar = 10 * size, width = 3 * pad + bar + widest;
  const int left = bitmap.width - width - pad, top = pad, height = bitmap.height - 2 * pad;
  bitmap.fill(left, top, width, height, paper);
  draw_text(bitmap, left + pad, top + pad, unit, ink, size);
  const int bar_top = top + 2 * pad + line, bar_height = height - 3 * pad - line - size * 4;
  for (int y = 0; y < bar_height; ++y) {
    const double t = 1.0 - static_cast<double>(y) / std::max(1, bar_height - 1);
    bitmap.fill(left + pad, bar_top + y, bar, 1, scale_colour(t));
  }
  std::size_t i = 0;
  for (double v : ticks(scale)) {
    const int y =
        bar_top + static_cast<int>(std::lround((1.0 - scale.position(v)) * (bar_height - 1)));
    bitmap.fill(left + pad + bar - 3 * size, y, 5 * size, size, ink);
    draw_text(bitmap, left + 2 * pad + bar, y - 4 * size, labels[i++], ink, size);
  }
}

}  // namespace

Rgb8 scale_colour(double t) {
  constexpr Rgb8 stops[] = {{48, 18, 59},   {68, 88, 203},  {62, 155, 254}, {24, 214, 203},
                            {70, 248, 132}, {162, 252, 60}, {225, 221, 55}, {254, 161, 49},
                            {239, 90, 17},  {196, 37, 3},   {122, 4, 3}};
  constexpr int last = static_cast<int>(std::size(stops)) - 1;
  const double x = std::clamp(t, 0.0, 1.0) * last;
  const int i = std::min(static_cast<int>(x), last - 1);
  Rgb8 colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double low = stops[i][c], high = stops[i + 1][c];
    colour[c] = static_cast<std::uint8_t>(std::lround(low + (x - i) * (high - low)));
  }
  return colour;
}

Bitmap false_coloured(const LightImage& image, const std::string& unit,
                      const FalseColourConfig& config) {
  const Scale scale = scale_for(image, config);
  Bitmap bitmap(image.width, image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const auto& p = image.pixels[i];
    const Rgb8 met =
        p.cover > 0.0f ? scale_colour(scale.position(p.irradiance / p.cover)) : nothing;
    for (std::size_t c = 0; c < 3; ++c) {
      const double empty = std::max(0.0, 1.0 - p.cover - p.section);
      bitmap.pixels[i][c] = static_cast<std::uint8_t>(
          std::lround(p.cover * met[c] + p.section * solid[c] + empty * nothing[c]));
    }
  }
  draw_legend(bitmap, scale, unit);
  return bitmap;
}

}  // namespace enfilade
