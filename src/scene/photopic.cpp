#include "scene/photopic.hpp"

namespace enfilade {

double photopic(std::span<const double> bands, ExitanceUnit unit) {
  double sum = 0.0;
  if (bands.size() == 3) {
    sum = unit == ExitanceUnit::lumen_per_m2
              ? 0.2126 * bands[0] + 0.7152 * bands[1] + 0.0722 * bands[2]
              : 0.265 * bands[0] + 0.670 * bands[1] + 0.065 * bands[2];
  } else {
    for (const double band : bands) sum += band / static_cast<double>(bands.size());
  }
  return sum / per_lumen(unit);
}

}  // namespace enfilade
