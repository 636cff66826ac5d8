#include "report/plans/plan_leaks.hpp"

#include <fmt/format.h>

#include <limits>

#include "report/plans/plan_colours.hpp"

namespace enfilade {

void draw_leaks(FloorPlan& plan, const std::vector<Storey>& storeys, std::span<const Leak> leaks) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const auto index = static_cast<std::size_t>(plan.storey - 1);
  const double from = index == 0 ? -far : storeys[index].floor_m;
  const double to = index + 1 < storeys.size() ? storeys[index + 1].floor_m : far;
  for (const Leak& leak : leaks) {
    const Vec3& start = leak.path.front();
    if (start.z < from || start.z >= to) continue;
    Shape way{"leak", {Path()}, std::nullopt, plan_ink::leak, 2.5, false, ""};
    for (const Vec3& p : leak.path) way.paths[0].emplace_back(p);
    way.tip = fmt::format("leak: {} of cell {}, {:.3g} m2, {:.3g} m wide", name_of(leak.kind),
                          leak.cell.value, leak.area_m2, leak.width_m);
    plan.drawing.map.push_back(std::move(way));
    plan.drawing.words.push_back(
        {plan.drawing.frame.to_px(Vec2(start)), "leak", 13.0, plan_ink::leak, true});
  }
}

}  // namespace enfilade
