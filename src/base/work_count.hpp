// Counts of work, in operations; the machine's cost model gives them a price.
#pragma once

#include <cstdint>

namespace enfilade {

/// The operations that a part of the computation has done.
struct WorkCount {
  std::uint64_t rays = 0;            ///< visibility rays cast
  std::uint64_t form_factors = 0;    ///< closed-form point-to-polygon factors evaluated
  std::uint64_t kernels = 0;         ///< point-to-point kernels evaluated
  std::uint64_t links_refined = 0;   ///< links replaced by finer ones
  std::uint64_t links_gathered = 0;  ///< links that light was gathered over
  std::uint64_t patches = 0;         ///< patches created
  std::uint64_t push_pulls = 0;      ///< patches visited by push-pull
  std::uint64_t shafts = 0;          ///< shaft queries

  WorkCount& operator+=(const WorkCount& o) {
    rays += o.rays;
    form_factors += o.form_factors;
    kernels += o.kernels;
    links_refined += o.links_refined;
    links_gathered += o.links_gathered;
    patches += o.patches;
    push_pulls += o.push_pulls;
    shafts += o.shafts;
    return *this;
  }
};

}  // namespace enfilade
