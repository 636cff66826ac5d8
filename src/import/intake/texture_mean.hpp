// What a texture comes to where a surface has one colour: its mean.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace enfilade {

struct TextureMean {
  std::array<double, 3> srgb{};    ///< of an image of colours: linear light, 0..1
  std::array<double, 4> linear{};  ///< of its values as they are, and of its alpha, 0..1
};

/// Returns the mean of a PNG, JPEG, BMP, TGA, PSD, GIF, HDR or PNM image; none where it cannot be
/// decoded.
std::optional<TextureMean> texture_mean(std::string_view bytes);

}  // namespace enfilade
