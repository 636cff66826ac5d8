// Plans as files: SVG or PNG by the file's ending.
#pragma once

#include <span>
#include <string>

#include "report/plans/floor_plan.hpp"

namespace enfilade {

/// Returns the bytes of the file that `path` names; it ends in .svg or .png.
std::string plan_content(const FloorPlan& plan, const std::string& path);
/// "plans/house.svg", 2 -> "plans/house-2.svg".
std::string numbered_path(const std::string& path, int number);
/// RUN/pictures/storey-1-cells.svg and .png, and so on.
void write_run_plans(const std::string& run_directory, std::span<const FloorPlan> plans);

}  // namespace enfilade
