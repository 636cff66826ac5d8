// An estimate of the form factor of two clusters from their boxes and areas: the edge weights of
// [6]'s graph (RR-3425 §2).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/geometry.hpp"
#include "clusters/cluster.hpp"

namespace enfilade {

/// Dimensionless, symmetric, in (0, 1]: A / (A + pi d^2), the form factor from a point to a disk of
/// area A that faces it at distance d. A is the geometric mean of the clusters' areas, since
/// by reciprocity one factor of a pair is too large for the smaller where the other is too small; d
/// lies between the centres of their boxes. Visibility and orientation do not enter: an edge of
/// G_cluster says already that the two may exchange light.
class FormFactorEstimate {
 public:
  /// Without clusters every pair weighs 1, as in G_val.
  FormFactorEstimate() = default;
  explicit FormFactorEstimate(std::span<const Cluster> clusters);

  double between(std::size_t a, std::size_t b) const;
  /// Returns the number of clusters; 0 where all pairs weigh 1.
  std::size_t size() const { return nodes_.size(); }

 private:
  struct Node {
    Vec3 centre;
    double root_area_m = 0.0;  ///< square root of the area
  };
  std::vector<Node> nodes_;
};

}  // namespace enfilade
