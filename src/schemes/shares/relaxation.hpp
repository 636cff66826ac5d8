// Chebyshev's factors for Richardson's iteration of light: far fewer iterations than Jacobi's, by
// products with the same frozen links alone.
#pragma once

#include <vector>

namespace enfilade {

/// The iteration x <- x + w (M x + b - x), whose matrix M has real eigenvalues (form factors are
/// reciprocal) between -radius and radius, takes the reciprocals of Chebyshev's roots in turn for
/// w. A cycle of n factors reduces the error by 1 / T_n(1 / radius), where Jacobi's reduces it by
/// radius^n. Where an eigenvalue up to 1 lies outside, the cycle still reduces its part of the
/// error, and measure() finds the radius by how much.
/// (Golub and Varga 1961. The roots come in Leja's order, the next one as far from those before as
/// can be, so that no partial product grows large: Reichel 1990.)
class ChebyshevCycle {
 public:
  /// `radius`: an estimate of the spectral radius, in (0, 1). The cycle is as long as it takes to
  /// reduce the error to the share `aim`, within limits.
  ChebyshevCycle(double radius, double aim);
  double radius() const { return radius_; }
  int length() const { return static_cast<int>(factors_.size()); }
  /// Returns the factor of step 0 .. length() - 1.
  double factor(int step) const { return factors_.at(static_cast<std::size_t>(step)); }
  /// Returns the radius at which the whole cycle leaves the share `left` of the residual: larger
  /// than radius() where it has reduced the residual by less than it should.
  double measured(double left) const;

 private:
  double radius_;
  std::vector<double> factors_;
};

}  // namespace enfilade
