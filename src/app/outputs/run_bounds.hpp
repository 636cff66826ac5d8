// Guaranteed intervals of the irradiance of a run's rooms and surfaces, and their table.
#pragma once

#include <string>
#include <vector>

#include "bounds/iteration/bound_irradiance.hpp"
#include "hierarchy/cluster_state.hpp"
#include "run/prepare.hpp"

namespace enfilade {

/// The prepared scene as bounds see it: all polygons of all clusters, in their order, and for each
/// cell that is no solid's inside its polygons.
struct BoundedRun {
  BoundScene scene;
  std::vector<SurfaceId> surface_of;  ///< of each polygon
  std::vector<CellId> cells;          ///< of each of scene.targets
};
BoundedRun bounded_run(const Prepared& prepared);

/// Returns the table as CSV: kind, name, then lower and upper per band of the file, the run's own
/// mean irradiance per band (`estimate`), area_m2, cell or index of the surface, object or storey,
/// and the unit of the irradiance. Kinds: `scene`, `room` (a cell that is a room), `outside` (a
/// cell outside of the building) and `surface`, in the scene file's order; a surface without area
/// (wholly covered or dropped) has empty bounds. Numbers are rounded outwards.
std::string bounds_csv(const Prepared& prepared, const BoundedRun& run, const BoundResult& bounds,
                       const std::vector<ClusterState>& solution);

/// Returns the name of a cell: that of the building's room around most of its area, else "cell 3".
std::string name_of_cell(const Prepared& prepared, CellId cell);

}  // namespace enfilade
