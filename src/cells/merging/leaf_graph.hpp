// The graph that merging works on: groups of leaves as nodes, their common faces as edges.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "cells/partition/interface.hpp"

namespace enfilade {

/// A side of a plane: plane * 2 for the side in front of it, plane * 2 + 1 for the one behind.
using PlaneSide = std::uint32_t;

/// Areas, m2: of the common face, of its openings, and of those openings that are framed like a
/// door.
struct Contact {
  double area = 0.0, open = 0.0, framed = 0.0;
};

/// Leaves that have been joined so far. A contact is filed under the side of the plane that this
/// group lies on.
struct LeafGroup {
  double volume = 0.0, front = 0.0, back = 0.0;  ///< m3; m2 of fronts and backs on its border
  std::map<PlaneSide, double> faces;             ///< m2
  std::map<std::uint32_t, std::map<PlaneSide, Contact>> contacts;  ///< by other group
  double own_boundary =
      -1.0;  ///< m2, without the solids that joined it; negative where none has joined

  /// The inside of a solid shows hardly anything but backs; real models show a room a few backs as
  /// well.
  bool is_solid() const { return back > 4.0 * front; }
  bool has_evidence() const { return back + front > 0.0; }
  double boundary() const;
  double open_to(std::uint32_t other) const;
  /// True where the openings in one side of one plane, to all neighbours together, exceed the area.
  bool opens_over(double m2) const;

  mutable double faces_m2 = -1.0;  ///< sum of `faces`; negative: to be found
  /// No side of a plane has more open than that, m2. It is added up as groups join, and found
  /// exactly where that does not answer a question.
  mutable double opening_bound_m2 = std::numeric_limits<double>::infinity();
  mutable bool opening_is_exact = false;
};

/// The groups and their contacts. Group 0 is the outside; leaf i begins as group i + 1.
class LeafGraph {
 public:
  static constexpr std::uint32_t outside = 0;

  LeafGraph(std::span<const double> volume_m3, std::span<const LeafInterface> interfaces);

  std::uint32_t size() const { return static_cast<std::uint32_t>(groups_.size()); }
  const LeafGroup& operator[](std::uint32_t i) const { return groups_[i]; }
  /// Returns the group that i has become part of.
  std::uint32_t find(std::uint32_t i) const;
  bool alive(std::uint32_t i) const { return parent_[i] == i; }
  /// One of two groups becomes part of the other; the outside stays the outside. A solid that joins
  /// a room leaves the room's measures as they are: all walls and floors of a building may leak
  /// into one room.
  void join(std::uint32_t g, std::uint32_t h);

 private:
  void add(const LeafInterface& face);
  void join_contacts(std::uint32_t g, std::uint32_t h);

  std::vector<LeafGroup> groups_;
  std::vector<std::uint32_t> parent_;
};

}  // namespace enfilade
