// Risers of steps, plane by plane: does one run all across a room, and part it in two?
#include "cells/rooms/floor_steps.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "cells/rooms/room_division.hpp"

namespace enfilade {
namespace {

/// An upright piece that may be the face of a step, with its extent along `along` and along up.
struct Riser {
  std::uint32_t piece = 0;
  Vec3 along{0.0};
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
};

/// Half of the volume of all rooms lies in rooms of at least this volume, m3.
double typical_room_m3(const CutSpace& space) {
  std::vector<double> volume(space.groups.kinds.size(), 0.0);
  double total = 0.0;
  for (std::size_t leaf = 0; leaf < space.tree.leaves.size(); ++leaf) {
    const std::uint32_t group = space.groups.group_of_leaf[leaf];
    if (space.groups.kinds[group] != CellKind::room) continue;
    const double v = volume_m3(space.tree.leaves[leaf]);
    volume[group] += v;
    total += v;
  }
  std::sort(volume.begin(), volume.end());
  double sum = 0.0;
  for (const double v : volume) {
    sum += v;
    if (2.0 * sum >= total) return v;
  }
  return 0.0;
}

Riser riser_of(const CutSpace& space, std::uint32_t piece) {
  const Polygon& polygon = space.pieces[piece].polygon;
  const StandingAxes axes =
      standing_axes(space.planes.planes[space.planes.plane_of_piece[piece]].n, space.up);
  Riser riser{piece, axes.along, 1e300, -1e300, 1e300, -1e300};
  for (const Vec3& p : polygon) {
    const double u = glm::dot(axes.along, p), v = glm::dot(axes.up, p);
    riser.u0 = std::min(riser.u0, u);
    riser.u1 = std::max(riser.u1, u);
    riser.v0 = std::min(riser.v0, v);
    riser.v1 = std::max(riser.v1, v);
  }
  return riser;
}

class StepFinder {
 public:
  StepFinder(CutSpace& space, LeafCutter& cutter, const StepConfig& config)
      : space_(space),
        cutter_(cutter),
        config_(config),
        least_m3_(config.part_share * typical_room_m3(space)) {}

  void run() {
    risers_ = risers_by_plane();
    for (const auto& [plane, risers] : risers_) {
      // Risers that an earlier cut has left in two rooms are tried in each.
      std::map<std::uint32_t, std::vector<Riser>> by_room;
      for (const Riser& riser : risers) {
        const std::uint32_t room = room_of(riser);
        if (space_.groups.kinds[room] == CellKind::room) by_room[room].push_back(riser);
      }
      for (const auto& [room, of_room] : by_room) try_plane(plane, room, of_room);
    }
  }

 private:
  /// Low vertical pieces (risers), grouped by plane; the plane with the greatest total riser length
  /// first.
  std::vector<std::pair<std::uint32_t, std::vector<Riser>>> risers_by_plane() const {
    std::map<std::uint32_t, std::vector<Riser>> by_plane;
    for (std::uint32_t i = 0; i < space_.pieces.size(); ++i) {
      const std::uint32_t plane = space_.planes.plane_of_piece[i];
      if (std::abs(glm::dot(space_.planes.planes[plane].n, space_.up)) > 0.1) continue;
      const Riser riser = riser_of(space_, i);
      if (riser.v1 - riser.v0 < config_.height_share * (riser.u1 - riser.u0)) {
        by_plane[plane].push_back(riser);
      }
    }
    std::vector<std::pair<double, std::uint32_t>> order;
    for (const auto& [plane, risers] : by_plane) {
      double length = 0.0;
      for (const Riser& riser : risers) length += riser.u1 - riser.u0;
      if (length >= 0.5 * std::cbrt(least_m3_)) order.emplace_back(-length, plane);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::pair<std::uint32_t, std::vector<Riser>>> sorted;
    for (const auto& [length, plane] : order) sorted.emplace_back(plane, by_plane.at(plane));
    return sorted;
  }

  /// The room that a riser's front faces. A step may sink into the lower floor, so that points at
  /// its top and at its bottom are tried.
  std::uint32_t room_of(const Riser& riser) const {
    const Polygon& polygon = space_.pieces[riser.piece].polygon;
    const Vec3 n = normal(polygon), middle = centroid(polygon);
    const StandingAxes axes = standing_axes(n, space_.up);
    const double near_m = 4.0 * space_.tolerance_m, v = glm::dot(axes.up, middle);
    std::uint32_t group = 0;
    for (const double share : {0.5, 0.15, 0.85}) {
      const double u = riser.u0 + share * (riser.u1 - riser.u0);
      for (const double height : {riser.v1 - near_m, riser.v0 + near_m}) {
        const Vec3 p = middle + (height - v) * axes.up + near_m * n +
                       (u - glm::dot(riser.along, middle)) * riser.along;
        group = space_.groups.group_of_leaf[cutter_.leaf_at(p)];
        if (space_.groups.kinds[group] == CellKind::room) return group;
      }
    }
    return group;
  }

  void try_plane(std::uint32_t plane, std::uint32_t room, const std::vector<Riser>& risers) {
    const std::vector<std::uint32_t>& leaves = cutter_.leaves_of(room);
    const Plane at = space_.planes.planes[plane];
    for (const auto& section : sections(space_, cutter_, leaves, plane)) {
      const double area = stepped_area(section, risers);
      if (area <= 0.0) continue;
      const Division division = divide(space_, cutter_, leaves, at, section);
      if (!division.separates) continue;
      const double less = std::min(division.front_m3, division.behind_m3);
      if (less < least_m3_ || less < config_.part_depth * area * std::sqrt(area)) continue;
      if (is_barrier(risers, config_.part_depth * std::sqrt(area))) continue;
      carry_out(cutter_, room, division, section, plane);
      return;
    }
  }

  /// Does the room go on below the riser's foot (`away` -1, `end` its height) or above its top (1),
  /// as at the rim of a stair's hole?
  bool is_open_beyond(const Riser& riser, double end, double away) const {
    const Polygon& polygon = space_.pieces[riser.piece].polygon;
    const Vec3 n = normal(polygon), middle = centroid(polygon);
    const StandingAxes axes = standing_axes(n, space_.up);
    const double near_m = 4.0 * space_.tolerance_m;
    const Vec3 foot = middle + (end - glm::dot(axes.up, middle)) * axes.up + near_m * n;
    const std::uint32_t here = cutter_.leaf_at(foot - away * near_m * axes.up);
    const std::uint32_t there = cutter_.leaf_at(foot + away * near_m * axes.up);
    if (space_.groups.kinds[space_.groups.group_of_leaf[here]] == CellKind::solid) return false;
    if (here == there) return true;
    for (const std::uint32_t i : cutter_.interfaces_of(here)) {
      const LeafInterface& face = space_.interfaces[i];
      if (face.front_leaf != there && face.back_leaf != there) continue;
      for (const Polygon& opening : face.openings) {
        if (bounds(opening).contains(foot, 2.0 * near_m)) return true;
      }
    }
    return false;
  }

  /// Has the step a face the other way close behind it, as a joist, a threshold or a low partition
  /// has?
  bool is_barrier(const std::vector<Riser>& risers, double reach_m) const {
    double length = 0.0, faced = 0.0;
    for (const Riser& riser : risers) {
      const Vec3 n = normal(space_.pieces[riser.piece].polygon);
      length += riser.u1 - riser.u0;
      double most = 0.0;
      for (const auto& [plane, others] : risers_) {
        const Plane& there = space_.planes.planes[plane];
        if (std::abs(glm::dot(there.n, n)) < 1.0 - 1e-6) continue;
        double sum = 0.0;
        for (const Riser& other : others) {
          const Polygon& polygon = space_.pieces[other.piece].polygon;
          const double behind = -glm::dot(n, polygon[0] - space_.pieces[riser.piece].polygon[0]);
          if (behind <= space_.tolerance_m || behind > reach_m ||
              glm::dot(normal(polygon), n) > 0.0)
            continue;
          if (other.v0 >= riser.v1 || other.v1 <= riser.v0) continue;
          const double sign = glm::dot(other.along, riser.along);
          const double u0 = sign > 0.0 ? other.u0 : -other.u1,
                       u1 = sign > 0.0 ? other.u1 : -other.u0;
          sum += std::max(0.0, std::min(u1, riser.u1) - std::max(u0, riser.u0));
        }
        most = std::max(most, sum);
      }
      faced += std::min(most, riser.u1 - riser.u0);
    }
    return 2.0 * faced > length;
  }

  /// The section's area where a step runs all across it, otherwise 0, m2.
  double stepped_area(const std::vector<SectionPart>& section,
                      const std::vector<Riser>& risers) const {
    double low = 1e300, high = -1e300, whole = 0.0;
    for (const SectionPart& part : section) {
      low = std::min(low, part.v0);
      high = std::max(high, part.v1);
      whole += part.area_m2;
    }
    const double height = config_.height_share * (high - low);
    std::vector<std::pair<double, double>> steps;
    for (const Riser& r : risers) {
      const bool at_floor = r.v0 >= low - height && r.v1 <= low + height;
      const bool at_ceiling = r.v1 <= high + height && r.v0 >= high - height;
      if ((at_floor && !is_open_beyond(r, r.v0, -1.0)) ||
          (at_ceiling && !is_open_beyond(r, r.v1, 1.0))) {
        steps.emplace_back(r.u0, r.u1);
      }
    }
    std::sort(steps.begin(), steps.end());
    double stepped = 0.0;
    for (const SectionPart& part : section) {
      double at = part.u0, length = 0.0;
      for (const auto& [from, to] : steps) {
        const double begin = std::max(from, at), end = std::min(to, part.u1);
        if (end <= begin) continue;
        length += end - begin;
        at = end;
      }
      stepped += part.area_m2 * length / std::max(part.u1 - part.u0, 1e-300);
    }
    return stepped >= config_.across_share * whole ? whole : 0.0;
  }

  CutSpace& space_;
  LeafCutter& cutter_;
  StepConfig config_;
  std::vector<std::pair<std::uint32_t, std::vector<Riser>>> risers_;  ///< by plane
  double least_m3_;
};

}  // namespace

void cut_at_steps(CutSpace& space, LeafCutter& cutter, const StepConfig& config) {
  StepFinder(space, cutter, config).run();
}

}  // namespace enfilade
