#include "import/intake/texture_mean.hpp"

#include <stb_image.h>

#include <cmath>
#include <limits>
#include <memory>

namespace enfilade {
namespace {

double linear_of_srgb(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

}  // namespace

std::optional<TextureMean> texture_mean(std::string_view bytes) {
  if (bytes.empty() || bytes.size() > std::size_t{std::numeric_limits<int>::max()}) return {};
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                            static_cast<int>(bytes.size()), &width, &height, &channels, 4),
      &stbi_image_free);
  if (!pixels || width <= 0 || height <= 0) return {};
  std::array<double, 256> table;
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = linear_of_srgb(static_cast<double>(i) / 255.0);
  TextureMean mean;
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      const stbi_uc value = pixels.get()[4 * i + c];
      if (c < 3) mean.srgb[c] += table[value];
      mean.linear[c] += value / 255.0;
    }
  }
  for (double& c : mean.srgb) c /= static_cast<double>(count);
  for (double& c : mean.linear) c /= static_cast<double>(count);
  return mean;
}

}  // namespace enfilade
