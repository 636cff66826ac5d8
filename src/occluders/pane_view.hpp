// What a point sees of a polygon through panes: parts that are seen through the same panes.
#pragma once

#include <span>
#include <vector>

#include "geometry/visible_parts.hpp"
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
/// quadrature. A part is not cut where the variation times its form factor is less than
/// `negligible`: of a polygon that is one of many. Replaces `parts`.
void cut_by_panes(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon,
                  std::span<const std::uint32_t> panes, const Occluders& occluders,
                  std::vector<DimmedPart>& parts, double negligible = 0.0);

/// The same for all of `visible`, as seen from x; returns the form factor of what passes.
double cut_by_panes(const Vec3& x, const Vec3& n, const VisibleParts& visible,
                    std::span<const std::uint32_t> panes, const Occluders& occluders,
                    std::vector<DimmedPart>& parts);

/// True where it is certain that nothing but panes stands between the convex hulls of a (on polygon
/// `own`) and of b, and that each of them covers the whole view.
bool only_whole_panes_between(const Polygon& a, std::uint32_t own, const Polygon& b,
                              const Occluders& occluders);

}  // namespace enfilade
