// The lines by which a plan shows portals and clusters.
#pragma once

#include <string>
#include <vector>

#include "report/drawing/drawing.hpp"
#include "report/plans/planned_building.hpp"
#include "report/plans/storeys.hpp"

namespace enfilade {

/// A storey and the height it is cut at.
struct PlanCut {
  Storey storey;  ///< its headroom ends at the next storey's floor
  double z_m = 0.0;
};

enum class PortalView {
  cut,     ///< a line across the opening
  beyond,  ///< wholly above or below the cut: a dashed line
  level    ///< an opening in a floor or a ceiling: hatched
};

/// What a portal leads to; a portal of a solid lets light into a cupboard or between two skins of a
/// wall.
enum class PortalSide { room, outside, solid };

struct PortalMark {
  PortalId id;
  PortalSide side = PortalSide::room;
  PortalView view = PortalView::cut;
  std::vector<Path> lines;  ///< metres
};
/// Returns the marks of the portals of the storey that `cut` names. Hatches and dashes are `step_m`
/// apart.
std::vector<PortalMark> portal_marks(const CellComplex& complex, const PlanCut& cut, double step_m);

struct ClusterMark {
  ClusterId id;
  bool below = false;       ///< stands on the floor and ends below the cut: rings of its footprint
  std::vector<Path> paths;  ///< lines where its surfaces are cut, or rings
};
/// Returns the marks of the clusters that the cut meets or that stand below it in the storey.
std::vector<ClusterMark> cluster_marks(std::span<const Cluster> clusters, const PlanCut& cut);

}  // namespace enfilade
