#include "report/plans/plan_subject.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace enfilade {

namespace {

/// More ranks than these have no line each in the legend.
constexpr int most_ranks_named = 16;

const char* kind_name(CellKind kind) {
  if (kind == CellKind::room) return "room";
  return kind == CellKind::outside ? "outside" : "inside of a solid";
}

std::string cell_name(const Cell& cell) {
  return fmt::format("cell {}, {}", cell.id.value, kind_name(cell.kind));
}

/// As for cells: kinds have their colours, clusters are black lines.
PlanSubject plain(const PlannedBuilding& building, const std::string& name) {
  PlanSubject subject;
  subject.name = name;
  subject.cells = cell_colours(building.cells);
  for (const Cell& cell : building.cells.cells()) subject.cell_tips.push_back(cell_name(cell));
  subject.clusters.resize(building.clusters.size());
  return subject;
}

void add_kind_keys(PlanSubject& subject) {
  subject.keys.push_back({plan_ink::outside, "outside"});
  subject.keys.push_back({plan_ink::solid, "inside of walls, floors, solids"});
}

/// The rank that has most of each cell's surface; -1 for a cell without clusters.
std::vector<int> rank_of_cells(const PlannedBuilding& building, std::span<const Rank> owner) {
  std::vector<std::map<int, double>> area_m2(building.cells.cells().size());
  for (std::size_t c = 0; c < building.clusters.size(); ++c) {
    const Cluster& cluster = building.clusters[c];
    if (cluster.cell.valid()) area_m2[cluster.cell.index()][owner[c].value] += cluster.area_m2;
  }
  std::vector<int> ranks;
  for (const auto& shares : area_m2) {
    const auto most =
        std::max_element(shares.begin(), shares.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    ranks.push_back(most == shares.end() ? -1 : most->first);
  }
  return ranks;
}

}  // namespace

VisibleSet visible_set(const CellComplex& complex, std::span<const Cluster> clusters,
                       const ClusterGraph& graph, CellId from) {
  VisibleSet set{from, std::vector<char>(complex.cells().size(), 0),
                 std::vector<char>(clusters.size(), 0)};
  std::vector<char> is_empty(complex.cells().size(), 1);
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (clusters[i].cell.valid()) is_empty[clusters[i].cell.index()] = 0;
    if (clusters[i].cell != from) continue;
    set.clusters[i] = 1;
    for (const std::uint32_t j : graph.neighbours(i)) set.clusters[j] = 1;
  }
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (set.clusters[i] && clusters[i].cell.valid()) set.cells[clusters[i].cell.index()] = 1;
  }
  for (const auto& [a, b] : visible_cells(complex)) {
    if (a != from && b != from) continue;
    const std::size_t other = a == from ? b.index() : a.index();
    if (is_empty[from.index()] || is_empty[other]) set.cells[other] = 1;
  }
  set.cells[from.index()] = 1;
  return set;
}

PlanSubject cells_subject(const PlannedBuilding& building) {
  PlanSubject subject = plain(building, "cells");
  const auto& cells = building.cells.cells();
  subject.subtitle = fmt::format("{} cells ({} of them rooms), {} portals, {} clusters",
                                 building.cells.open_cells(),
                                 std::ranges::count(cells, CellKind::room, &Cell::kind),
                                 building.cells.portals().size(), building.clusters.size());
  add_kind_keys(subject);
  return subject;
}

PlanSubject visible_subject(const PlannedBuilding& building, const VisibleSet& set) {
  PlanSubject subject = plain(building, "visible");
  for (std::size_t c = 0; c < set.cells.size(); ++c) {
    const bool solid = building.cells.cells()[c].kind == CellKind::solid;
    subject.cells[c] = set.cells[c] ? plan_ink::seen : solid ? plan_ink::solid : plan_ink::unseen;
    if (set.cells[c]) subject.cell_tips[c] += ", visible";
  }
  subject.cells[set.from.index()] = plan_ink::chosen;
  for (std::size_t i = 0; i < set.clusters.size(); ++i) {
    ClusterInk& ink = subject.clusters[i];
    if (set.clusters[i]) {
      ink = {plan_ink::black, 2.6, plan_ink::soft, "visible"};
    } else {
      ink = {plan_ink::faint, 1.2, std::nullopt, ""};
    }
  }
  std::size_t cells = 0;
  for (const Cell& cell : building.cells.cells()) {
    if (cell.kind != CellKind::solid && set.cells[cell.id.index()]) ++cells;
  }
  const bool is_outside = building.cells.cells()[set.from.index()].kind == CellKind::outside;
  subject.subtitle = fmt::format("from cell {}{}: {} of {} cells and {} of {} clusters are visible",
                                 set.from.value, is_outside ? " (outside)" : "", cells,
                                 building.cells.open_cells(), std::ranges::count(set.clusters, 1),
                                 set.clusters.size());
  subject.keys = {{plan_ink::chosen, fmt::format("cell {}", set.from.value)},
                  {plan_ink::seen, "cells whose clusters its clusters see"},
                  {plan_ink::unseen, "other cells"},
                  {plan_ink::solid, "inside of walls, floors, solids"},
                  {plan_ink::black, "clusters that its clusters see", true},
                  {plan_ink::faint, "other clusters", true}};
  return subject;
}

PlanSubject assignment_subject(const PlannedBuilding& building, std::span<const Rank> owner) {
  PlanSubject subject = plain(building, "assignment");
  const std::vector<int> ranks = rank_of_cells(building, owner);
  for (std::size_t c = 0; c < ranks.size(); ++c) {
    if (building.cells.cells()[c].kind != CellKind::room || ranks[c] < 0) continue;
    subject.cells[c] = tint(rank_rgb(ranks[c]), 0.35);
    subject.cell_tips[c] += fmt::format(", mostly rank {}", ranks[c]);
  }
  std::map<int, std::size_t> clusters_of;
  for (std::size_t i = 0; i < building.clusters.size(); ++i) {
    const int rank = owner[i].value;
    ++clusters_of[rank];
    subject.clusters[i] = {rank_rgb(rank), 3.4, rank_rgb(rank), fmt::format("rank {}", rank)};
  }
  const int count = clusters_of.empty() ? 0 : clusters_of.rbegin()->first + 1;
  subject.subtitle =
      fmt::format("{} clusters on {} ranks; a cell's tint is the rank with most of its surface",
                  building.clusters.size(), count);
  for (int rank = 0; rank < std::min(count, most_ranks_named); ++rank) {
    subject.keys.push_back(
        {rank_rgb(rank), fmt::format("rank {}: {} clusters", rank, clusters_of[rank])});
  }
  if (count > most_ranks_named) subject.keys.push_back({{255, 255, 255}, "... and so on"});
  add_kind_keys(subject);
  subject.portals = false;
  return subject;
}

}  // namespace enfilade
