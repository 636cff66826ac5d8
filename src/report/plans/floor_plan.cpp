#include "report/plans/floor_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "report/plans/level_section.hpp"
#include "report/plans/plan_marks.hpp"
#include "report/plans/plan_outline.hpp"
#include "report/plans/plan_sheet.hpp"

namespace enfilade {

namespace {

std::vector<Path> ground_paths(const std::vector<Polygon>& polygons) {
  std::vector<Path> paths;
  for (const Polygon& polygon : polygons) paths.emplace_back(polygon.begin(), polygon.end());
  return paths;
}

void draw_cells(Drawing& drawing, const std::vector<CellSection>& sections,
                const PlanSubject& subject) {
  for (const CellSection& section : sections) {
    const bool known = section.cell.valid();
    const Rgb8 colour = known ? subject.cells[section.cell.index()] : plan_ink::solid;
    // The thin stroke closes the hairlines that viewers leave between areas.
    Shape shape{"cell", ground_paths(section.parts), colour, colour, 0.6, true, ""};
    if (known)
      shape.tip = fmt::format("{}, {:.4g} m2 here", subject.cell_tips[section.cell.index()],
                              section.area_m2);
    drawing.map.push_back(std::move(shape));
  }
}

void draw_clusters(Drawing& drawing, const PlannedBuilding& building,
                   const std::vector<ClusterMark>& marks, const PlanSubject& subject) {
  // Visible clusters, with their stronger lines, over hidden ones.
  std::vector<const ClusterMark*> order;
  for (const ClusterMark& mark : marks) order.push_back(&mark);
  const auto ink = [&](const ClusterMark* mark) -> const ClusterInk& {
    return subject.clusters[mark->id.index()];
  };
  std::ranges::stable_sort(order, [&](const auto* a, const auto* b) {
    return std::tuple(!a->below, ink(a).width_px) < std::tuple(!b->below, ink(b).width_px);
  });
  for (const ClusterMark* mark : order) {
    const Cluster& cluster = building.clusters[mark->id.index()];
    Shape shape;
    shape.kind = mark->below ? "furniture" : "surface";
    shape.paths = mark->paths;
    shape.closed = mark->below;
    if (mark->below) shape.fill = ink(mark).fill;
    shape.stroke =
        mark->below && ink(mark).line == plan_ink::black ? plan_ink::soft : ink(mark).line;
    shape.width_px = mark->below ? 1.0 : ink(mark).width_px;
    shape.tip = fmt::format("cluster {}", cluster.id.value);
    if (cluster.cell.valid()) shape.tip += fmt::format(", cell {}", cluster.cell.value);
    for (const std::string& more : {cluster.object, ink(mark).tip}) {
      if (!more.empty()) shape.tip += ", " + more;
    }
    drawing.map.push_back(std::move(shape));
  }
}

Rgb8 ink_of(PortalSide side) {
  if (side == PortalSide::solid) return plan_ink::into_solid;
  return side == PortalSide::outside ? plan_ink::to_outside : plan_ink::doorway;
}

void draw_portals(Drawing& drawing, const CellComplex& complex,
                  const std::vector<PortalMark>& marks) {
  // Doorways come last, over what leads into solids.
  std::vector<PortalMark> order = marks;
  std::ranges::stable_sort(order, std::greater<>(), &PortalMark::side);
  for (const PortalMark& mark : order) {
    const Portal& portal = complex.portals()[mark.id.index()];
    Shape shape;
    shape.kind = "portal";
    shape.paths = mark.lines;
    shape.closed = false;
    shape.stroke = ink_of(mark.side);
    if (mark.view == PortalView::level) {
      shape.width_px = 1.0;
    } else {
      shape.width_px = mark.side == PortalSide::solid ? 2.0
                       : mark.view == PortalView::cut ? 4.0
                                                      : 3.0;
    }
    shape.tip = fmt::format("portal {}, cells {} and {}, {:.3g} m2", mark.id.value, portal.a.value,
                            portal.b.value, area_m2(portal.polygon));
    drawing.map.push_back(std::move(shape));
  }
}

/// Numbers of cells where they fit, larger cells first; none over another.
void write_numbers(Drawing& drawing, const CellComplex& complex, const PlanSubject& subject,
                   std::vector<CellSection> sections) {
  std::ranges::stable_sort(sections,
                           [](const auto& a, const auto& b) { return a.area_m2 > b.area_m2; });
  std::vector<Box> taken;
  for (const CellSection& section : sections) {
    if (!section.cell.valid()) continue;
    if (complex.cells()[section.cell.index()].kind == CellKind::solid) continue;
    const InnerCircle circle = largest_circle(section.parts);
    Words words{drawing.frame.to_px(circle.centre), std::to_string(section.cell.value), 0.0,
                plan_ink::black, true};
    const double radius_px = circle.radius_m * drawing.frame.px_per_m;
    words.size_px = std::clamp(0.8 * radius_px, 11.0, 21.0);
    const double half_px = 0.5 * width_px(words);
    if (radius_px < 4.0) continue;
    Box box;
    box.add(Vec3(words.at_px - Vec2(half_px, 0.5 * words.size_px), 0.0));
    box.add(Vec3(words.at_px + Vec2(half_px, 0.5 * words.size_px), 0.0));
    if (std::ranges::any_of(taken, [&](const Box& b) { return b.overlaps(box); })) continue;
    taken.push_back(box);
    const Vec2 lo(box.lo), hi(box.hi), more(3.0, 2.0);
    drawing.sheet.push_back(
        {"number",
         {{lo - more, {hi.x + more.x, lo.y - more.y}, hi + more, {lo.x - more.x, hi.y + more.y}}},
         subject.cells[section.cell.index()],
         std::nullopt,
         0.0,
         true,
         ""});
    drawing.words.push_back(words);
  }
}

PlanContents contents_of(const std::vector<PortalMark>& portals,
                         const std::vector<ClusterMark>& clusters) {
  PlanContents contents;
  for (const PortalMark& mark : portals) {
    contents.doorways |= mark.side == PortalSide::room;
    contents.to_outside |= mark.side == PortalSide::outside;
    contents.into_solids |= mark.side == PortalSide::solid;
    contents.beyond |= mark.view == PortalView::beyond;
    contents.level |= mark.view == PortalView::level;
  }
  contents.furniture = std::ranges::any_of(clusters, &ClusterMark::below);
  return contents;
}

}  // namespace

FloorPlan floor_plan(const PlannedBuilding& building, const std::vector<Storey>& storeys,
                     int number, const PlanSubject& subject, const FloorPlanConfig& config) {
  const auto index = static_cast<std::size_t>(number - 1);
  Storey storey = storeys[index];
  if (index + 1 < storeys.size())
    storey.headroom_m = std::min(storey.headroom_m, storeys[index + 1].floor_m - storey.floor_m);
  const PlanCut cut{storey, storey.floor_m + std::min(config.cut_m, 0.45 * storey.headroom_m)};
  FloorPlan plan{
      number,
      subject.name,
      fmt::format("Storey {}: floor at {:.2f} m, cut at {:.2f} m", number, storey.floor_m, cut.z_m),
      {}};
  const Box ground = room_bounds(building);
  const double step_m = std::max(ground.extent().x, ground.extent().y) / 130.0;
  std::vector<PortalMark> portals;
  if (subject.portals) portals = portal_marks(building.cells, cut, step_m);
  const std::vector<ClusterMark> clusters = cluster_marks(building.clusters, cut);
  plan.drawing = plan_sheet(ground, plan.title, subject, contents_of(portals, clusters));
  Box frame;
  frame.add(Vec3(plan.drawing.frame.lo_m, 0.0));
  frame.add(Vec3(plan.drawing.frame.hi_m, 0.0));
  const auto sections = level_section(building.cells, frame, cut.z_m);
  draw_cells(plan.drawing, sections, subject);
  draw_clusters(plan.drawing, building, clusters, subject);
  draw_portals(plan.drawing, building.cells, portals);
  write_numbers(plan.drawing, building.cells, subject, sections);
  return plan;
}

std::vector<FloorPlan> floor_plans(const PlannedBuilding& building, const PlanSubject& subject,
                                   const FloorPlanConfig& config) {
  const std::vector<Storey> all = storeys(building);
  std::vector<FloorPlan> plans;
  for (int number = 1; number <= static_cast<int>(all.size()); ++number) {
    plans.push_back(floor_plan(building, all, number, subject, config));
  }
  return plans;
}

}  // namespace enfilade
