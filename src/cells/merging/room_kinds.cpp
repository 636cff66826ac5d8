#include "cells/merging/room_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace enfilade {
namespace {

// Mean chord of a region, 4 V / S (Cauchy), m.
double chord(const LeafGroup& g) {
  const double boundary = g.boundary();
  return boundary > 0.0 ? 4.0 * g.volume / boundary : 0.0;
}

double volume(const LeafGroup& g) { return g.volume; }

// Returns the volume-weighted median of the chord or the volume of the groups that are not solid.
double typical(const LeafGraph& graph, double (*measure)(const LeafGroup&)) {
  std::vector<std::pair<double, double>> by_measure;  // and volume
  double total = 0.0;
  for (std::uint32_t i = 1; i < graph.size(); ++i) {
    if (!graph.alive(i) || graph[i].is_solid()) continue;
    by_measure.emplace_back(measure(graph[i]), graph[i].volume);
    total += graph[i].volume;
  }
  std::sort(by_measure.begin(), by_measure.end());
  double sum = 0.0;
  for (const auto& [value, share] : by_measure) {
    sum += share;
    if (2.0 * sum >= total) return value;
  }
  return 0.0;
}

// Has the group a door to a group that is a room, or to the outside?
bool has_door(const LeafGroup& g, const std::vector<char>& is_room, double door_share) {
  std::map<PlaneSide, double> open;
  for (const auto& [other, sides] : g.contacts) {
    if (!is_room[other]) continue;
    for (const auto& [side, contact] : sides) open[side] += contact.open;
  }
  return std::any_of(open.begin(), open.end(), [&](const auto& at) {
    const double face = std::max(g.faces.at(at.first), std::pow(g.volume, 2.0 / 3.0));
    return at.second >= door_share * face;
  });
}

}  // namespace

double typical_volume_m3(const LeafGraph& graph) { return typical(graph, volume); }

// Real walls and floors are layers with faces of every direction between them, so that the faces
// alone do not distinguish their insides from rooms.
std::vector<char> find_rooms(const LeafGraph& graph, const RoomConfig& config) {
  std::vector<char> is_room(graph.size(), 0);
  is_room[LeafGraph::outside] = 1;
  const double least = config.thin_share * typical(graph, chord);
  const double closet = config.closet_share * typical_volume_m3(graph);
  for (std::uint32_t i = 1; i < graph.size(); ++i) {
    is_room[i] = graph.alive(i) && !graph[i].is_solid() && chord(graph[i]) >= least;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t i = 1; i < graph.size(); ++i) {
      if (!graph.alive(i) || is_room[i] || graph[i].is_solid()) continue;
      if (graph[i].volume < closet) continue;
      if (!has_door(graph[i], is_room, config.door_share)) continue;
      is_room[i] = 1;
      changed = true;
    }
  }
  return is_room;
}

}  // namespace enfilade
