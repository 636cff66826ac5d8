#include "far_field/portal_exchange.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace enfilade {
namespace {

/// Cells with more doorways, as the space around a building, are bounded by the other side alone:
/// each doorway costs time for each link.
constexpr std::size_t most_doorways = 16;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// A bound of the form factor from anywhere to m2 of polygons at a distance.
double factor_bound(double m2, double gap) {
  return gap > 0.0 ? std::min(1.0, m2 / (std::numbers::pi * gap * gap)) : 1.0;
}

/// A bound of the cosine at a plane of any line from it to the box, `gap` away or further.
double cosine_bound(const Plane& plane, const Box& box, double gap, double slack_m) {
  const double height = highest_distance(box, plane) + slack_m;
  if (height <= 0.0) return 0.0;
  return height < gap ? height / gap : 1.0;
}

/// Of the openings of two doorways, each of which faces away from its own cell.
double between(const Doorway& a, const Doorway& b, double slack_m) {
  const double a_m2 = area_m2(a.polygon), b_m2 = area_m2(b.polygon);
  if (a.portal == b.portal) return a_m2;
  const double gap = gap_m(a.box, b.box);
  const double at_a = cosine_bound(a.plane, b.box, gap, slack_m);
  const double at_b = cosine_bound(b.plane, a.box, gap, slack_m);
  // Directions with cosines below c send c^2 of all that a diffuse plane sends.
  const double touching = std::min(a_m2 * at_a * at_a, b_m2 * at_b * at_b);
  if (gap <= 0.0) return touching;
  return std::min(touching, at_a * at_b * a_m2 * b_m2 / (std::numbers::pi * gap * gap));
}

}  // namespace

void PortalExchange::Entries::add(const Doorway& doorway) {
  m2 += area_m2(doorway.polygon);
  box.add(doorway.box);
}

PortalExchange::PortalExchange(const BuildingTree& tree, const CellSights& sights)
    : tree_(tree),
      doorways_(sights.doorways()),
      of_node_(tree.nodes().size()),
      of_place_(tree.cells().size()),
      doorways_of_place_(tree.cells().size()) {
  for (std::uint32_t place = 0; place < tree.cells().size(); ++place) {
    for (const Doorway& doorway : doorways_.of(tree.cells()[place]))
      add_entry(doorway, place, tree.place_of(doorway.leads_to));
  }
  for (const ClusterId cluster : sights.sticking_out()) {
    const std::span<const CellId> cells = sights.cells_of(cluster);
    const std::uint32_t place = tree.place_of(cells.front());
    for (const CellId cell : cells.subspan(1)) {
      std::vector<std::uint32_t>& reach = reach_into_[cell];
      if (std::find(reach.begin(), reach.end(), place) != reach.end()) continue;
      reach.push_back(place);
      for (const Doorway& doorway : doorways_.of(cell))
        add_entry(doorway, place, tree.place_of(doorway.leads_to));
    }
  }
}

void PortalExchange::add_entry(const Doorway& doorway, std::uint32_t place,
                               std::uint32_t from_place) {
  const auto contains = [](const BuildingTree::Node& node, std::uint32_t p) {
    return node.first_cell <= p && p < node.end_cell;
  };
  std::uint32_t at = BuildingTree::root;
  while (!is_one_cell(tree_.node(at))) {
    if (!contains(tree_.node(at), from_place)) of_node_[at].add(doorway);
    const std::uint32_t left = tree_.node(at).left;
    at = contains(tree_.node(left), place) ? left : tree_.node(at).right;
  }
  of_place_[place].add(doorway);
  doorways_of_place_[place].push_back(&doorway);
}

bool PortalExchange::shares_cell(std::span<const CellId> own,
                                 const BuildingTree::Node& node) const {
  const auto within = [&node](std::uint32_t p) {
    return node.first_cell <= p && p < node.end_cell;
  };
  return std::any_of(own.begin(), own.end(), [&](CellId cell) {
    if (within(tree_.place_of(cell))) return true;
    const auto reach = reach_into_.find(cell);
    return reach != reach_into_.end() &&
           std::any_of(reach->second.begin(), reach->second.end(), within);
  });
}

double PortalExchange::from_doorway(const Doorway& out, std::uint32_t node) const {
  const Entries& entries = entries_of(node);
  const double out_m2 = area_m2(out.polygon);
  const double gap = gap_m(out.box, entries.box);
  const double cosine = cosine_bound(out.plane, entries.box, gap, doorways_.slack_m());
  const double bound = out_m2 * cosine * std::min(cosine, factor_bound(entries.m2, gap));
  const BuildingTree::Node& n = tree_.node(node);
  if (!is_one_cell(n) || doorways_of_place_[n.first_cell].size() > most_doorways) return bound;
  double sum = 0.0;
  for (const Doorway* in : doorways_of_place_[n.first_cell]) {
    sum += between(out, *in, doorways_.slack_m());
    if (sum >= bound) return bound;
  }
  return sum;
}

double PortalExchange::bound_m2(std::span<const CellId> own, const Box& box, double m2,
                                std::uint32_t node) const {
  if (shares_cell(own, tree_.node(node))) return infinite;
  const Entries& entries = entries_of(node);
  const double most = std::min(entries.m2, m2 * factor_bound(entries.m2, gap_m(box, entries.box)));
  double sum = 0.0;
  for (const CellId cell : own) {
    const std::span<const Doorway> doorways = doorways_.of(cell);
    if (doorways.size() > most_doorways) return most;
    for (const Doorway& out : doorways) {
      const double near = m2 * factor_bound(area_m2(out.polygon), gap_m(box, out.box));
      sum += std::min(near, from_doorway(out, node));
      if (sum >= most) return most;
    }
  }
  return sum;
}

}  // namespace enfilade
