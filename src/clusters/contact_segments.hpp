// Where other polygons touch or cross a polygon's plane: the lines along which light can end.
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

  /// Edges of other polygons that lie in the plane of polygon `i`, and the lines in which others
  /// cross it: what of them lies inside the polygon and not along its own edges. Longest first.
  std::vector<Segment> inside(std::size_t i) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Fills ClusterPolygon::contacts: of each polygon the `most` longest.
void find_contacts(std::span<Cluster> clusters, double tolerance_m, const ContactConfig& config);

}  // namespace enfilade
