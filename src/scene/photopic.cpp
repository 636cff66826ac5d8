#include "scene/photopic.hpp"

#include "scene/equal_bands.hpp"

namespace enfilade {
namespace {

constexpr double of_red = 0.2126, of_green = 0.7152, of_blue = 0.0722;

}  // namespace

double photopic(const Scene& scene, std::span<const double> solved) {
  const Spectrum bands = in_bands_of_file(scene, solved);
  if (bands.size() == 3) return of_red * bands[0] + of_green * bands[1] + of_blue * bands[2];
  double sum = 0.0;
  for (const double value : bands) sum += value;
  return bands.empty() ? 0.0 : sum / static_cast<double>(bands.size());
}

std::string photopic_words(const Scene& scene) {
  const std::size_t bands = bands_of_file(scene);
  if (bands == 3) return "0.2126 R + 0.7152 G + 0.0722 B";
  return bands <= 1 ? "" : "mean of " + std::to_string(bands) + " bands";
}

}  // namespace enfilade
