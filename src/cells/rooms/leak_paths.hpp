// Ways from inside a room through one of its openings to the open, leaf by leaf.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cells/rooms/leaf_cutter.hpp"

namespace enfilade {

/// Returns the mean of a region's vertices, each counted once per facet.
Vec3 middle_of(const Region& region);

/// Keeps references to the cut leaves; `touches_border` tells the leaves at the scene's border.
class LeakPaths {
 public:
  LeakPaths(const CutSpace& space, const LeafCutter& cutter, std::span<const char> touches_border)
      : space_(space), cutter_(cutter), touches_border_(touches_border) {}

  /// From the middle of the room's largest leaf through the point `gap` of a portal to the border.
  std::vector<Vec3> through(const Portal& portal, const Vec3& gap, CellId room) const;
  /// Adds the shortest way (in leaves) from a leaf to the border, within the leaf's group; nothing
  /// where there is none.
  void add_way_out(std::uint32_t leaf, std::vector<Vec3>& path) const;

 private:
  template <class IsGoal>
  void add_way(std::uint32_t from, IsGoal is_goal, std::vector<Vec3>& path) const;

  const CutSpace& space_;
  const LeafCutter& cutter_;
  std::span<const char> touches_border_;
};

}  // namespace enfilade
