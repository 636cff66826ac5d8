#include "schemes/shares/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace enfilade {
namespace {

constexpr double least_radius = 0.2, most_radius = 0.99;
constexpr double least_length = 4.0, most_length = 24.0;

/// Chebyshev's roots in (-1, 1), in Leja's order.
std::vector<double> roots_in_order(int n) {
  std::vector<double> left, ordered;
  for (int k = 0; k < n; ++k) left.push_back(std::cos((k + 0.5) * std::numbers::pi / n));
  while (!left.empty()) {
    // The logarithm of the distances' product; at first the root that is farthest from 0.
    const auto distance = [&ordered](double root) {
      double sum = ordered.empty() ? std::log(std::abs(root)) : 0.0;
      for (const double other : ordered) sum += std::log(std::abs(root - other));
      return sum;
    };
    const auto next = std::ranges::max_element(left, {}, distance);
    ordered.push_back(*next);
    left.erase(next);
  }
  return ordered;
}

}  // namespace

ChebyshevCycle::ChebyshevCycle(double radius, double aim)
    : radius_(std::clamp(radius, least_radius, most_radius)) {
  // T_n(x) = cosh(n acosh(x)).
  const double length = std::acosh(std::max(1.0, 1.0 / aim)) / std::acosh(1.0 / radius_);
  const int n = static_cast<int>(std::ceil(std::clamp(length, least_length, most_length)));
  for (const double root : roots_in_order(n)) factors_.push_back(1.0 / (1.0 - radius_ * root));
}

double ChebyshevCycle::measured(double left) const {
  const double beyond = left * std::cosh(length() * std::acosh(1.0 / radius_));
  if (!(beyond > 1.0)) return radius_;
  return std::min(most_radius, radius_ * std::cosh(std::acosh(beyond) / length()));
}

}  // namespace enfilade
