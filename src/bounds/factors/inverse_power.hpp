// Polynomials below and above a power of the squared distance, over a range of it.
#pragma once

#include <array>

namespace enfilade {

/// A polynomial of degree up to 3 in Newton's form about its nodes.
struct NewtonCubic {
  std::array<double, 4> coefficient{};
  std::array<double, 3> node{};
  double operator()(double s) const {
    return coefficient[0] +
           (s - node[0]) *
               (coefficient[1] + (s - node[1]) * (coefficient[2] + (s - node[2]) * coefficient[3]));
  }
};

/// Two polynomials with below(s) <= s^power <= above(s) for all s in [least, most].
struct PowerBounds {
  NewtonCubic below, above;
};

/// Returns such polynomials; 0 < least <= most, power < 0. s^power is completely monotone: its
/// derivatives alternate in sign, so that the error of a Hermite interpolation has the sign of the
/// product of the distances from its nodes. Degree 1 (`cubic` false): the tangent in the middle is
/// below, the chord above. Degree 3: two double nodes give one below, the ends and a double node in
/// the middle one above; for s^-2 the relative gap is about 1.25 d^4 (degree 1: 3 d^2) where d is
/// the half width of the range over its middle.
PowerBounds bound_power(double power, double least, double most, bool cubic);

}  // namespace enfilade
