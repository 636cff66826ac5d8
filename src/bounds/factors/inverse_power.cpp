#include "bounds/factors/inverse_power.hpp"

#include <cmath>
#include <numbers>

namespace enfilade {
namespace {

/// The Hermite interpolation of s^power at the nodes (equal ones side by side), by divided
/// differences.
template <std::size_t n>
NewtonCubic interpolate(double power, const std::array<double, n>& nodes) {
  std::array<double, n> difference{};
  for (std::size_t i = 0; i < n; ++i) difference[i] = std::pow(nodes[i], power);
  NewtonCubic cubic;
  cubic.coefficient[0] = difference[0];
  for (std::size_t order = 1; order < n; ++order) {
    for (std::size_t i = 0; i + order < n; ++i) {
      const double width = nodes[i + order] - nodes[i];
      difference[i] = width == 0.0 ? power * std::pow(nodes[i], power - 1.0)
                                   : (difference[i + 1] - difference[i]) / width;
    }
    cubic.coefficient[order] = difference[0];
    cubic.node[order - 1] = nodes[order - 1];
  }
  return cubic;
}

}  // namespace

PowerBounds bound_power(double power, double least, double most, bool cubic) {
  const double middle = 0.5 * (least + most), half = 0.5 * (most - least);
  if (half <= 1e-9 * middle) {  // divided differences would be all rounding
    PowerBounds constant;
    constant.below.coefficient[0] = std::pow(most, power);
    constant.above.coefficient[0] = std::pow(least, power);
    return constant;
  }
  if (!cubic) {
    return {interpolate<2>(power, {middle, middle}), interpolate<2>(power, {least, most})};
  }
  const double a = middle - half / std::numbers::sqrt2, b = middle + half / std::numbers::sqrt2;
  return {interpolate<4>(power, {a, a, b, b}),
          interpolate<4>(power, {least, middle, middle, most})};
}

}  // namespace enfilade
