// An affine function fitted to values at a patch's four quadrature points.
#pragma once

#include <array>

#include "hierarchy/patch_shape.hpp"

namespace enfilade {

/// Least-squares affine fit to values at PatchShape::quadrature, in the patch's principal axes.
/// Mean, slopes and saddle reproduce the four values exactly, so the saddle is what an affine
/// function cannot represent of them.
struct FourPointFit {
  double mean = 0.0;
  double slope1 = 0.0, slope2 = 0.0;  ///< per standard deviation along the first and second axis
  double saddle = 0.0;

  static FourPointFit of(const std::array<double, 4>& e) {
    return {0.25 * (e[0] + e[1] + e[2] + e[3]), 0.25 * (e[1] + e[3] - e[0] - e[2]),
            0.25 * (e[2] + e[3] - e[0] - e[1]), 0.25 * (e[0] - e[1] - e[2] + e[3])};
  }
};

}  // namespace enfilade
