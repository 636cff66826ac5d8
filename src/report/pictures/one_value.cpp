#include "report/pictures/one_value.hpp"

#include "scene/equal_bands.hpp"
#include "scene/photopic.hpp"

namespace enfilade {

double one_value(const Scene& scene, std::span<const double> solved) {
  return photopic(in_bands_of_file(scene, solved), scene.unit) * per_lumen(scene.unit);
}

std::string weights_of(const Scene& scene) {
  const std::size_t bands = bands_of_file(scene);
  if (bands <= 1) return "";
  if (bands != 3) return "mean of " + std::to_string(bands) + " bands";
  return scene.unit == ExitanceUnit::lumen_per_m2 ? "0.2126 R + 0.7152 G + 0.0722 B"
                                                  : "0.265 R + 0.670 G + 0.065 B";
}

}  // namespace enfilade
