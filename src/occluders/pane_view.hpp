// What a point sees of a polygon through panes: parts that are seen through the same panes.
#pragma once

#include <span>
#include <vector>

#include "occluders/occluders.hpp"

namespace enfilade {

/// A part of a polygon, and what passes from it: the mean over the part, as the point's form factor
/// weighs it.
struct DimmedPart {
  Polygon polygon;
  double factor = 0.0;  ///< form factor as if there were no pane
  Passage passage;
};

/// Cuts a convex polygon, as x with unit normal n sees it, along the outlines of the panes (global
/// numbers) and then until what passes varies little within each part: the mean is one by
/// quadrature. `tolerance_m` as of VisibleParts. Replaces `parts`.
void cut_by_panes(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon,
                  std::span<const std::uint32_t> panes, const Occluders& occluders,
                  std::vector<DimmedPart>& parts);

}  // namespace enfilade
