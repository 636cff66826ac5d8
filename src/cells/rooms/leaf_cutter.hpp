// Cuts merged rooms again: leaves of the partition are split, and their interfaces with them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cells/merging/leaf_merge.hpp"
#include "cells/partition/bsp.hpp"
#include "cells/partition/interface.hpp"
#include "cells/partition/plane_set.hpp"

namespace enfilade {

/// The partition and its groups, as the cutting of rooms changes them.
struct CutSpace {
  std::span<const Piece> pieces;
  PlaneSet& planes;
  BspTree& tree;
  std::vector<LeafInterface>& interfaces;  ///< after a cut no longer ordered by cut
  LeafGroups& groups;
  Vec3 up{0.0};  ///< at right angles to most floors, of either sign
  double tolerance_m = 0.0;
};

/// Splits leaves and moves them between groups, and keeps all lists of a CutSpace consistent.
class LeafCutter {
 public:
  explicit LeafCutter(CutSpace& space);

  /// Returns the leaf that p lies in.
  std::uint32_t leaf_at(const Vec3& p) const;
  /// Returns the leaves of one group, in the order of their numbers.
  const std::vector<std::uint32_t>& leaves_of(std::uint32_t group) const {
    return leaves_of_group_[group];
  }
  /// Puts a leaf into another group.
  void assign(std::uint32_t leaf, std::uint32_t group);
  /// Returns the indices of the interfaces that a leaf has.
  const std::vector<std::uint32_t>& interfaces_of(std::uint32_t leaf) const {
    return by_leaf_[leaf];
  }
  /// Returns the number of a plane in the plane set; a plane that no piece lies in is added to the
  /// set.
  std::uint32_t number_of(const Plane& plane);
  /// Two leaves, of the same group; the same leaf twice where it is not cut.
  struct Split {
    bool cut = false;
    std::uint32_t front = 0, behind = 0;
  };
  /// Cuts the leaf where the plane runs through it by more than the tolerance.
  Split cut(std::uint32_t leaf, std::uint32_t plane);
  /// Adds a group of the kind of `like`, and returns its number.
  std::uint32_t new_group(std::uint32_t like);

 private:
  void split_interfaces(std::uint32_t leaf, std::uint32_t front, std::uint32_t plane);
  void add_interface(LeafInterface face);
  std::vector<Polygon> open_parts(const BspCut& cut) const;

  CutSpace& space_;
  std::vector<std::int32_t> node_of_leaf_;
  std::vector<std::vector<std::uint32_t>> leaves_of_group_;
  std::vector<std::vector<std::uint32_t>> by_leaf_;  ///< interfaces
  std::vector<std::vector<std::uint32_t>> pieces_of_plane_;
};

}  // namespace enfilade
