#include "schemes/shares/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace enfilade {
namespace {

constexpr double least_radius = 0.2, most_radius = 0.99;
constexpr std::array<int, ChebyshevCycle::length> order = {0, 7, 3, 4, 1, 6, 2, 5};

}  // namespace

ChebyshevCycle::ChebyshevCycle(double radius)
    : radius_(std::clamp(radius, least_radius, most_radius)) {}

double ChebyshevCycle::factor(int iteration) const {
  const int root = order.at(static_cast<std::size_t>(iteration % length));
  return 1.0 / (1.0 - radius_ * std::cos((root + 0.5) * std::numbers::pi / length));
}

void ChebyshevCycle::measure(double reduction) {
  // T_n(x) = cosh(n acosh(x)): the eigenvalue whose part of the error shrinks as was seen.
  const double beyond = reduction * std::cosh(length * std::acosh(1.0 / radius_));
  if (!(beyond > 1.0)) return;
  radius_ = std::min(most_radius, radius_ * std::cosh(std::acosh(beyond) / length));
}

}  // namespace enfilade
