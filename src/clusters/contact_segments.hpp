// Contacts: segments in which other polygons touch or cross a polygon. Light can end along them
// (D0 discontinuities of the radiosity, Heckbert 1992).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "clusters/cluster.hpp"
#include "geometry/polygon.hpp"

namespace enfilade {

/// Finds the contacts of one polygon of a scene with all others, over an R-tree of their boxes.
class ContactSegments {
 public:
  /// Vertices within `tolerance_m` of a plane lie in it; segments shorter than `min_length_m` are
  /// left out. Keeps pointers to the polygons.
  ContactSegments(std::span<const Polygon* const> polygons, double tolerance_m,
                  double min_length_m);
  ~ContactSegments();

  /// Returns the edges of other polygons that lie in the plane of polygon `i`, and segments in
  /// which others cross that plane: their parts inside the polygon, but for those along its own
  /// edges. Longest first.
  std::vector<Segment> inside(std::size_t i) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Fills ClusterPolygon::contacts with the `config.most` longest contacts of each polygon.
void find_contacts(std::span<Cluster> clusters, double tolerance_m, const ContactConfig& config);

}  // namespace enfilade
