// How large the estimated errors of a cluster's links are, patch by patch, beside their light.
#pragma once

#include <vector>

#include "hierarchy/link.hpp"

namespace enfilade {

/// Sums the errors of the links of one receiving cluster while its light is gathered.
class LinkErrors {
 public:
  /// Adds the estimated error of the power that a link brings to its receiver; a group's goes to
  /// its polygons by area.
  void add(const PatchForest& receiver, const Link& link, double power);
  /// Sets PatchForest::link_error() of all nodes, for the irradiance that they have.
  void set(PatchForest& receiver);

 private:
  std::vector<double> irradiance_;  ///< per node
};

}  // namespace enfilade
