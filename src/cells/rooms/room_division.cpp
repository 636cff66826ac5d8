// A section of a room in its connected parts, and a flood fill from both sides of one of them.
#include "cells/rooms/room_division.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace enfilade {
namespace {

enum : char { in_front = 1, in_back = 2, on_section = 4 };

/// Bits that say on which sides of the plane a polygon has vertices.
char side_of(const Polygon& polygon, const Plane& plane, double tolerance) {
  const DistanceRange range = distances(polygon, plane);
  char side = 0;
  if (range.highest > tolerance) side |= in_front;
  if (range.lowest < -tolerance) side |= in_back;
  return side;
}

char side_of(const Region& region, const Plane& plane, double tolerance) {
  char side = 0;
  for (const Facet& facet : region.facets) side |= side_of(facet.polygon, plane, tolerance);
  return side;
}

bool touch(const SectionPart& a, const SectionPart& b, double tolerance) {
  return a.u0 <= b.u1 + tolerance && b.u0 <= a.u1 + tolerance && a.v0 <= b.v1 + tolerance &&
         b.v0 <= a.v1 + tolerance;
}

SectionPart part_of(std::uint32_t leaf, std::uint32_t interface, Polygon polygon,
                    const StandingAxes& axes) {
  constexpr double far = std::numeric_limits<double>::infinity();
  SectionPart part{leaf, interface, {}, area_m2(polygon), far, -far, far, -far};
  for (const Vec3& p : polygon) {
    const double u = glm::dot(axes.along, p), v = glm::dot(axes.up, p);
    part.u0 = std::min(part.u0, u);
    part.u1 = std::max(part.u1, u);
    part.v0 = std::min(part.v0, v);
    part.v1 = std::max(part.v1, v);
  }
  part.polygon = std::move(polygon);
  return part;
}

/// Flood fill of a room's leaves from both sides of a section.
class Flood {
 public:
  Flood(const CutSpace& space, const LeafCutter& cutter, const std::vector<std::uint32_t>& leaves,
        const Plane& plane)
      : space_(space), cutter_(cutter), plane_(plane) {
    for (const std::uint32_t leaf : leaves) side_[leaf] = 0;
  }

  void run(const std::vector<SectionPart>& section) {
    for (const SectionPart& part : section) {
      if (part.leaf != SectionPart::none) {
        side_[part.leaf] = on_section;
      } else {
        barrier_.insert(part.interface);
      }
    }
    for (const SectionPart& part : section) {
      if (part.leaf != SectionPart::none) {
        step(part.leaf, 0);
      } else {
        const LeafInterface& face = space_.interfaces[part.interface];
        reach(face.front_leaf, in_front);
        reach(face.back_leaf, in_back);
      }
    }
    while (!queue_.empty()) {
      const auto [leaf, side] = queue_.back();
      queue_.pop_back();
      step(leaf, side);
    }
  }
  const std::map<std::uint32_t, char>& sides() const { return side_; }

 private:
  void reach(std::uint32_t leaf, char side) {
    const auto at = side_.find(leaf);
    if (at == side_.end() || at->second == on_section || (at->second | side) == at->second) return;
    at->second |= side;
    queue_.emplace_back(leaf, at->second);
  }
  void step(std::uint32_t leaf, char side) {
    for (const std::uint32_t i : cutter_.interfaces_of(leaf)) {
      const LeafInterface& face = space_.interfaces[i];
      if (face.openings.empty() || barrier_.contains(i)) continue;
      char reached = side;
      if (side == 0) {
        for (const Polygon& p : face.openings) reached |= side_of(p, plane_, space_.tolerance_m);
      }
      reach(face.other_than(leaf), reached);
    }
  }

  const CutSpace& space_;
  const LeafCutter& cutter_;
  const Plane& plane_;
  std::map<std::uint32_t, char> side_;
  std::set<std::uint32_t> barrier_;  ///< interfaces in the section
  std::vector<std::pair<std::uint32_t, char>> queue_;
};

}  // namespace

StandingAxes standing_axes(const Vec3& n, const Vec3& up) {
  const Vec3 along = glm::normalize(glm::cross(up, n));
  return {along, glm::cross(n, along)};
}

std::vector<std::vector<SectionPart>> sections(const CutSpace& space, const LeafCutter& cutter,
                                               const std::vector<std::uint32_t>& leaves,
                                               std::uint32_t plane_number) {
  const Plane& plane = space.planes.planes[plane_number];
  const StandingAxes axes = standing_axes(plane.n, space.up);
  std::vector<SectionPart> parts;
  for (const std::uint32_t leaf : leaves) {
    for (const std::uint32_t i : cutter.interfaces_of(leaf)) {
      const LeafInterface& face = space.interfaces[i];
      if (face.plane != plane_number || face.front_leaf != leaf) continue;
      const auto& groups = space.groups.group_of_leaf;
      if (groups[face.front_leaf] != groups[face.back_leaf]) continue;
      for (const Polygon& opening : face.openings) {
        parts.push_back(part_of(SectionPart::none, i, opening, axes));
      }
    }
    const Region& region = space.tree.leaves[leaf];
    if (side_of(region, plane, space.tolerance_m) != (in_front | in_back)) continue;
    Polygon polygon = cross_section(region, plane);
    if (polygon.size() < 3) continue;
    parts.push_back(part_of(leaf, SectionPart::none, std::move(polygon), axes));
  }
  std::vector<std::vector<SectionPart>> found;
  std::vector<char> done(parts.size(), 0);
  for (std::size_t first = 0; first < parts.size(); ++first) {
    if (done[first]) continue;
    std::vector<SectionPart> whole{parts[first]};
    done[first] = 1;
    for (std::size_t k = 0; k < whole.size(); ++k) {
      for (std::size_t i = first + 1; i < parts.size(); ++i) {
        if (done[i] || !touch(whole[k], parts[i], 2.0 * space.tolerance_m)) continue;
        done[i] = 1;
        whole.push_back(parts[i]);
      }
    }
    found.push_back(std::move(whole));
  }
  return found;
}

Division divide(const CutSpace& space, const LeafCutter& cutter,
                const std::vector<std::uint32_t>& leaves, const Plane& plane,
                const std::vector<SectionPart>& section) {
  Flood flood(space, cutter, leaves, plane);
  flood.run(section);
  Division division;
  for (const auto& [leaf, side] : flood.sides()) {
    const Region& region = space.tree.leaves[leaf];
    if (side == (in_front | in_back)) return division;
    if (side == on_section) continue;
    const double volume = volume_m3(region);
    bool front = side == in_front;
    if (side == 0) {  // cut off from both sides: by the mean of its vertices
      double sum = 0.0;
      for (const Facet& facet : region.facets) {
        for (const Vec3& p : facet.polygon) sum += plane.signed_distance(p);
      }
      front = sum >= 0.0;
    }
    (front ? division.front : division.behind).push_back(leaf);
    (front ? division.front_m3 : division.behind_m3) += volume;
  }
  for (const SectionPart& part : section) {
    if (part.leaf == SectionPart::none) continue;
    const auto [before, behind] = split_region(space.tree.leaves[part.leaf], plane, part.polygon);
    division.front_m3 += volume_m3(before);
    division.behind_m3 += volume_m3(behind);
  }
  division.separates = true;
  return division;
}

void carry_out(LeafCutter& cutter, std::uint32_t group, const Division& division,
               const std::vector<SectionPart>& section, std::uint32_t plane) {
  const std::uint32_t in_front_of_it = cutter.new_group(group);
  for (const std::uint32_t leaf : division.front) {
    cutter.assign(leaf, in_front_of_it);
  }
  for (const SectionPart& part : section) {
    if (part.leaf == SectionPart::none) continue;
    const LeafCutter::Split halves = cutter.cut(part.leaf, plane);
    if (halves.cut) cutter.assign(halves.front, in_front_of_it);
  }
}

}  // namespace enfilade
