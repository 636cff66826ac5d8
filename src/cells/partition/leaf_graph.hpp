// Leaves that belong together so far, and how they touch.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "cells/partition/interface.hpp"

namespace enfilade {

/// A side of a plane: plane * 2 for the side in front of it, plane * 2 + 1 for the one behind.
using PlaneSide = std::uint32_t;

/// Areas, m2: of the common face, of what is open of it, and of that what is framed like a door.
struct Contact {
  double area = 0.0, open = 0.0, framed = 0.0;
};

/// Leaves that belong together so far. A contact is filed under the plane side that this group is
/// on.
struct LeafGroup {
  double volume = 0.0, front = 0.0, back = 0.0;  ///< m3; m2 of fronts and backs that it is shown
  std::map<PlaneSide, double> faces;             ///< m2
  std::map<std::uint32_t, std::map<PlaneSide, Contact>> contacts;  ///< by other group
  double own_boundary =
      -1.0;  ///< m2, less the solids that it has taken in; negative: there are none

  /// Real models show a room a wrong side here and there; the inside of a solid shows hardly
  /// anything else.
  bool is_solid() const { return back > 4.0 * front; }
  bool has_evidence() const { return back + front > 0.0; }
  double boundary() const;
  double open_to(std::uint32_t other) const;
  /// The largest opening in one side of one plane, to whomever.
  double largest_opening() const;
};

/// The groups and their contacts. Group 0 is the outside; leaf i begins as group i + 1.
class LeafGraph {
 public:
  static constexpr std::uint32_t outside = 0;

  LeafGraph(std::span<const double> volume_m3, std::span<const LeafInterface> interfaces);

  std::uint32_t size() const { return static_cast<std::uint32_t>(groups_.size()); }
  const LeafGroup& operator[](std::uint32_t i) const { return groups_[i]; }
  /// The group that i has become part of.
  std::uint32_t find(std::uint32_t i) const;
  bool alive(std::uint32_t i) const { return parent_[i] == i; }
  /// One of two groups becomes part of the other; the outside stays the outside. A solid that joins
  /// what is none leaves it what it is: all walls and floors of a building may leak into one room.
  void join(std::uint32_t g, std::uint32_t h);

 private:
  void add(const LeafInterface& face);
  void join_contacts(std::uint32_t g, std::uint32_t h);

  std::vector<LeafGroup> groups_;
  std::vector<std::uint32_t> parent_;
};

}  // namespace enfilade
