// The sheet around a plan: title, legend, scale bar.
#pragma once

#include <string>
#include <vector>

#include "report/drawing/drawing.hpp"
#include "report/plans/plan_subject.hpp"

namespace enfilade {

/// The marks that a plan shows besides its subject's colours, for the legend.
struct PlanContents {
  bool doorways = false, to_outside = false, into_solids = false, beyond = false, level = false;
  bool furniture = false;
};

/// Makes a drawing with a frame for `ground` (metres, x and y), a margin around it included, its
/// title, subtitle, legend and scale bar.
Drawing plan_sheet(const Box& ground, const std::string& title, const PlanSubject& subject,
                   const PlanContents& contents);

}  // namespace enfilade
