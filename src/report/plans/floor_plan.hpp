// Plans: a level cut through each storey's cells, portals and clusters.
#pragma once

#include <string>
#include <vector>

#include "report/drawing/drawing.hpp"
#include "report/plans/plan_subject.hpp"
#include "report/plans/planned_building.hpp"
#include "report/plans/storeys.hpp"

namespace enfilade {

struct FloorPlan {
  int storey = 1;       ///< lowest = 1
  std::string subject;  ///< PlanSubject::name
  std::string title;    ///< "Storey 1: floor at 0.00 m, cut at 1.20 m"
  Drawing drawing;
};

struct FloorPlanConfig {
  double cut_m = 1.2;  ///< above the storey's floor; never above 45% of its height
};

/// Returns one storey, as the subject colours it; `storeys` are all, `number` counts from 1.
FloorPlan floor_plan(const PlannedBuilding& building, const std::vector<Storey>& storeys,
                     int number, const PlanSubject& subject, const FloorPlanConfig& config = {});
/// Returns all storeys, lowest first.
std::vector<FloorPlan> floor_plans(const PlannedBuilding& building, const PlanSubject& subject,
                                   const FloorPlanConfig& config = {});

}  // namespace enfilade
