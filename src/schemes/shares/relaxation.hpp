// Chebyshev's factors for Richardson's iteration of light: far fewer iterations than Jacobi's, by
// products with the same frozen links alone.
#pragma once

#include <array>

namespace enfilade {

/// The iteration x <- x + w (M x + b - x), whose matrix M has real eigenvalues (form factors are
/// reciprocal) between -radius and radius, takes the reciprocals of Chebyshev's roots in turn for
/// w. A cycle of n factors reduces the error by 1 / T_n(1 / radius), where Jacobi's reduces it by
/// radius^n. Where an eigenvalue up to 1 lies outside, the cycle still reduces its part of the
/// error, and measure() finds the radius by how much.
/// (Golub and Varga 1961; the order of the roots keeps every partial product small: Lebedev and
/// Finogenov 1971.)
class ChebyshevCycle {
 public:
  static constexpr int length = 8;

  /// `radius`: an estimate of the spectral radius, in (0, 1).
  explicit ChebyshevCycle(double radius);
  double radius() const { return radius_; }
  /// Returns the factor of iteration 0, 1, ...; it begins again after each cycle.
  double factor(int iteration) const;
  /// Enlarges the radius where a whole cycle has reduced the residual by less than it should:
  /// `reduction` is the residual after it over the one before.
  void measure(double reduction);

 private:
  double radius_;
};

}  // namespace enfilade
