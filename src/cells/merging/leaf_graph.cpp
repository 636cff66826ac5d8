// Joining groups: measures are added, contacts are moved to the group that stays.
#include "cells/merging/leaf_graph.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace enfilade {
namespace {

void lower(std::map<PlaneSide, double>& faces, PlaneSide side, double area) {
  const auto at = faces.find(side);
  if (at != faces.end()) at->second = std::max(0.0, at->second - area);
}

void add_contact(Contact& to, const Contact& contact) {
  to.area += contact.area;
  to.open += contact.open;
  to.framed += contact.framed;
}

/// Adds the measures (m2 and m3) of `from` to those of `to`.
void join_measures(LeafGroup& to, const LeafGroup& from, std::uint32_t from_number) {
  double common = 0.0;
  const auto at = to.contacts.find(from_number);
  if (at != to.contacts.end()) {
    for (const auto& [side, contact] : at->second) common += contact.area;
  }
  if (to.own_boundary >= 0.0 || from.own_boundary >= 0.0) {
    to.own_boundary = std::max(0.0, to.boundary() + from.boundary() - 2.0 * common);
  }
  to.volume += from.volume;
  to.front += from.front;
  to.back += from.back;
}

}  // namespace

double LeafGroup::boundary() const {
  if (own_boundary >= 0.0) return own_boundary;
  if (faces_m2 >= 0.0) return faces_m2;
  faces_m2 = 0.0;
  for (const auto& [side, area] : faces) faces_m2 += area;
  return faces_m2;
}

double LeafGroup::open_to(std::uint32_t other) const {
  double sum = 0.0;
  const auto at = contacts.find(other);
  if (at == contacts.end()) return 0.0;
  for (const auto& [side, contact] : at->second) sum += contact.open;
  return sum;
}

bool LeafGroup::opens_over(double m2) const {
  if (opening_is_exact || opening_bound_m2 <= m2) return opening_bound_m2 > m2;
  std::map<PlaneSide, double> by_side;
  for (const auto& [other, sides] : contacts) {
    for (const auto& [side, contact] : sides) by_side[side] += contact.open;
  }
  opening_bound_m2 = 0.0;
  for (const auto& [side, open] : by_side) opening_bound_m2 = std::max(opening_bound_m2, open);
  opening_is_exact = true;
  return opening_bound_m2 > m2;
}

LeafGraph::LeafGraph(std::span<const double> volume_m3, std::span<const LeafInterface> interfaces)
    : groups_(volume_m3.size() + 1), parent_(volume_m3.size() + 1) {
  std::iota(parent_.begin(), parent_.end(), 0u);
  for (std::size_t i = 0; i < volume_m3.size(); ++i) groups_[i + 1].volume = volume_m3[i];
  for (const LeafInterface& face : interfaces) add(face);
}

std::uint32_t LeafGraph::find(std::uint32_t i) const {
  while (parent_[i] != i) i = parent_[i];
  return i;
}

void LeafGraph::add(const LeafInterface& face) {
  const std::uint32_t a = face.front_leaf + 1, b = face.back_leaf + 1;
  const PlaneSide in_front = 2 * face.plane, behind = in_front + 1;
  const auto meet = [&](std::uint32_t g, std::uint32_t h, PlaneSide side) {
    groups_[g].faces[side] += face.area_m2;
    add_contact(groups_[g].contacts[h][side], {face.area_m2, face.open_m2, face.framed_m2});
  };
  meet(a, b, in_front);
  meet(b, a, behind);
  // A covering polygon that does not face a leaf shows it a back: the inside of something solid.
  const double covered = face.area_m2 - face.open_m2;
  groups_[a].front += face.faces_front_m2;
  groups_[a].back += std::max(0.0, covered - face.faces_front_m2);
  groups_[b].front += face.faces_back_m2;
  groups_[b].back += std::max(0.0, covered - face.faces_back_m2);
}

void LeafGraph::join(std::uint32_t g, std::uint32_t h) {
  g = find(g);
  h = find(h);
  if (g == h) return;
  if (h == outside) std::swap(g, h);
  // Contacts are moved from the smaller map, so that a big group stays cheap to add to.
  if (g != outside && groups_[h].contacts.size() > groups_[g].contacts.size()) std::swap(g, h);
  LeafGroup& to = groups_[g];
  LeafGroup& from = groups_[h];
  const bool takes_solid = from.is_solid() && !to.is_solid() && to.has_evidence();
  const bool is_taken = to.is_solid() && !from.is_solid() && from.has_evidence() && g != outside;
  if (takes_solid) {
    to.own_boundary = to.boundary();
  } else if (is_taken) {
    to.own_boundary = from.boundary();
    to.volume = from.volume;
    to.front = from.front;
    to.back = from.back;
  } else {
    join_measures(to, from, h);
  }
  join_contacts(g, h);
  parent_[h] = g;
}

void LeafGraph::join_contacts(std::uint32_t g, std::uint32_t h) {
  LeafGroup& to = groups_[g];
  LeafGroup& from = groups_[h];
  for (const auto& [side, area] : from.faces) to.faces[side] += area;
  for (const auto& [side, contact] : from.contacts[g]) {
    lower(to.faces, side, contact.area);
    lower(to.faces, side ^ 1u, contact.area);
  }
  to.contacts.erase(h);
  from.contacts.erase(g);
  to.faces_m2 = -1.0;
  to.opening_is_exact = false;
  to.opening_bound_m2 += from.opening_bound_m2;  // a third group's openings stay as they are
  for (const auto& [other, sides] : from.contacts) {
    auto& there = groups_[other].contacts;
    for (const auto& [side, contact] : sides) {
      add_contact(to.contacts[other][side], contact);
      add_contact(there[g][side ^ 1u], contact);
    }
    there.erase(h);
  }
  from = LeafGroup{};
}

}  // namespace enfilade
