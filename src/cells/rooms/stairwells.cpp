// Holes in floors with a flight under them: the box around such a hole is cut out of both rooms.
#include "cells/rooms/stairwells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/smaller_parts.hpp"
#include "cells/rooms/plan_box.hpp"
#include "geometry/box_tree.hpp"

namespace enfilade {
namespace {

/// A level or sloping piece: the top of a tread, or its underside.
struct Tread {
  Vec3 middle{0.0};
  double height_m = 0.0;
  double plan_m2 = 0.0;
  bool rises = false;  ///< faces up
};

class StairwellFinder {
 public:
  StairwellFinder(CutSpace& space, LeafCutter& cutter, const StairwellConfig& config)
      : space_(space), cutter_(cutter), config_(config) {
    for (const Piece& piece : space.pieces) {
      const double rise = glm::dot(normal(piece.polygon), space.up);
      if (std::abs(rise) < 0.5) continue;
      const double plan_m2 = area_m2(piece.polygon) * std::abs(rise);
      const Vec3 middle = centroid(piece.polygon);
      treads_.push_back({middle, glm::dot(space.up, middle), plan_m2, rise > 0.0});
    }
    std::stable_sort(treads_.begin(), treads_.end(),
                     [](const Tread& a, const Tread& b) { return a.height_m < b.height_m; });
    index_leaves();
  }

  void run() {
    for (const auto& [rooms, points] : ways_up()) {
      const PlanBox box = box_around(points, space_.up);
      if (box.area_m2() <= 0.0 || share_in(box, rooms) > config_.rooms_share) continue;
      if (!has_flight(box, rooms, points)) continue;
      cut(box, rooms);
    }
  }

 private:
  using Rooms = std::pair<std::uint32_t, std::uint32_t>;

  /// By two rooms one above the other, the corners of all openings between them.
  std::map<Rooms, std::vector<Vec3>> ways_up() const {
    std::map<Rooms, std::vector<Vec3>> ways;
    for (const LeafInterface& face : space_.interfaces) {
      const std::uint32_t a = space_.groups.group_of_leaf[face.front_leaf];
      const std::uint32_t b = space_.groups.group_of_leaf[face.back_leaf];
      if (a == b || space_.groups.kinds[a] != CellKind::room) continue;
      if (space_.groups.kinds[b] != CellKind::room) continue;
      if (std::abs(glm::dot(face.n, space_.up)) < 0.9) continue;
      for (const Polygon& opening : face.openings) {
        auto& points = ways[std::minmax(a, b)];
        points.insert(points.end(), opening.begin(), opening.end());
      }
    }
    return ways;
  }

  /// Heights that a flight may climb: from the lowest ground in the box to the hole's upper rim,
  /// and, since `up` may point down, from the hole's lower rim to the highest ground.
  std::array<std::pair<double, double>, 2> climbs(const PlanBox& box, const Rooms& rooms,
                                                  const std::vector<Vec3>& points) const {
    double low = 1e300, high = -1e300, rim_low = 1e300, rim_high = -1e300;
    for (const Vec3& p : points) {
      rim_low = std::min(rim_low, glm::dot(space_.up, p));
      rim_high = std::max(rim_high, glm::dot(space_.up, p));
    }
    for (const std::uint32_t leaf : leaves_near(box, rooms)) {
      const Region inside = box.part_of(space_.tree.leaves[leaf]);
      for (const Facet& facet : inside.facets) {
        for (const Vec3& p : facet.polygon) {
          low = std::min(low, glm::dot(space_.up, p));
          high = std::max(high, glm::dot(space_.up, p));
        }
      }
    }
    return {std::pair{low, rim_high}, std::pair{rim_low, high}};
  }

  std::vector<Tread>::const_iterator first_above(double height_m) const {
    return std::upper_bound(treads_.begin(), treads_.end(), height_m,
                            [](double height, const Tread& t) { return height < t.height_m; });
  }

  bool has_flight(const PlanBox& box, const Rooms& rooms, const std::vector<Vec3>& points) const {
    for (const auto& [from, to] : climbs(box, rooms, points)) {
      // Area in plan by facing and by quarter of the climb, m2.
      std::array<std::array<double, 4>, 2> covered{};
      const double height = to - from;
      for (auto tread = first_above(from + 0.02 * height);
           tread != treads_.end() && tread->height_m < from + 0.98 * height; ++tread) {
        if (!box.contains(tread->middle)) continue;
        const double at = (tread->height_m - from) / height;
        covered[tread->rises ? 0 : 1][static_cast<std::size_t>(4.0 * at)] += tread->plan_m2;
      }
      const double least = 0.25 * config_.tread_share * box.area_m2();
      for (const auto& quarters : covered) {
        if (*std::min_element(quarters.begin(), quarters.end()) >= least) return true;
      }
    }
    return false;
  }

  /// A stairwell's room may run through all storeys, and is looked at in each of them.
  double volume_of(std::uint32_t leaf) {
    volumes_m3_.resize(space_.tree.leaves.size(), -1.0);
    double& m3 = volumes_m3_[leaf];
    if (m3 < 0.0) m3 = volume_m3(space_.tree.leaves[leaf]);
    return m3;
  }

  double volume_in(const PlanBox& box, std::uint32_t leaf) {
    const Region& region = space_.tree.leaves[leaf];
    switch (box.position_of(region)) {
      case PlanBox::Position::outside:
        return 0.0;
      case PlanBox::Position::inside:
        return volume_of(leaf);
      case PlanBox::Position::across:
        return volume_m3(box.part_of(region));
    }
    return 0.0;
  }

  void index_leaves() {
    for (; boxed_ < space_.tree.leaves.size(); ++boxed_)
      leaf_boxes_.add(bounds(space_.tree.leaves[boxed_]));
  }

  /// The leaves of the rooms that may touch the box, in ascending order. A room may have leaves in
  /// all of the building: what leaks into it is part of it.
  std::vector<std::uint32_t> leaves_near(const PlanBox& box, const Rooms& rooms) const {
    std::vector<std::uint32_t> leaves = leaf_boxes_.touching(box.bounds(space_.up), 0.0);
    std::erase_if(leaves, [&](std::uint32_t leaf) {
      const std::uint32_t room = space_.groups.group_of_leaf[leaf];
      return room != rooms.first && room != rooms.second;
    });
    return leaves;
  }

  double room_volume(std::uint32_t room) {
    const auto [at, is_new] = room_m3_.try_emplace(room, 0.0);
    if (is_new) {
      for (const std::uint32_t leaf : cutter_.leaves_of(room)) at->second += volume_of(leaf);
    }
    return at->second;
  }

  double share_in(const PlanBox& box, const Rooms& rooms) {
    const double whole = room_volume(rooms.first) + room_volume(rooms.second);
    double inside = 0.0;
    for (const std::uint32_t leaf : leaves_near(box, rooms)) inside += volume_in(box, leaf);
    return whole > 0.0 ? inside / whole : 0.0;
  }

  void cut(const PlanBox& box, const Rooms& rooms) {
    std::array<std::uint32_t, 4> sides{};
    for (std::size_t i = 0; i < 4; ++i) sides[i] = cutter_.number_of(box.sides()[i]);
    const std::uint32_t well = cutter_.new_group(rooms.first);
    for (const std::uint32_t leaf : leaves_near(box, rooms)) cut_leaf(leaf, box, sides, well);
    index_leaves();
    for (const std::uint32_t room : {rooms.first, rooms.second}) take_cut_off_parts(room, well);
  }

  void cut_leaf(std::uint32_t leaf, const PlanBox& box, const std::array<std::uint32_t, 4>& sides,
                std::uint32_t well) {
    const double whole = volume_of(leaf);
    if (volume_in(box, leaf) <= 1e-6 * whole) return;
    for (const std::uint32_t side : sides) {
      const Plane plane = space_.planes.planes[side];
      // A plane of the scene's pieces may face the other way than the side does.
      const LeafCutter::Split halves = cutter_.cut(leaf, side);
      if (!halves.cut) continue;
      // The part behind keeps the number; a part in front is new, and has no volume yet.
      if (leaf < volumes_m3_.size()) volumes_m3_[leaf] = -1.0;
      leaf = keeps_inside(plane, box) ? halves.behind : halves.front;
    }
    move(leaf, well);
  }

  static bool keeps_inside(const Plane& plane, const PlanBox& box) {
    const Vec3 middle = 0.5 * ((box.u0 + box.u1) * box.u + (box.v0 + box.v1) * box.v);
    return plane.signed_distance(middle) < 0.0;
  }

  /// Calls `take` with the leaves of a group that a leaf is open to.
  template <class Take>
  void for_each_open_to(std::uint32_t leaf, std::uint32_t group, Take take) const {
    for (const std::uint32_t i : cutter_.interfaces_of(leaf)) {
      const LeafInterface& face = space_.interfaces[i];
      const std::uint32_t other = face.other_than(leaf);
      if (!face.openings.empty() && space_.groups.group_of_leaf[other] == group) take(other);
    }
  }

  /// Parts of a room that the stairwell cuts off from the room's largest part join the stairwell.
  void take_cut_off_parts(std::uint32_t room, std::uint32_t well) {
    std::vector<std::uint32_t> around;
    for (const std::uint32_t leaf : cutter_.leaves_of(well))
      for_each_open_to(leaf, room, [&](std::uint32_t other) { around.push_back(other); });
    const PartGraph graph{
        [&](std::uint32_t leaf, const auto& take) { for_each_open_to(leaf, room, take); },
        [&](std::uint32_t leaf) { return volume_of(leaf); }, room_volume(room)};
    for (const std::uint32_t leaf : smaller_parts(around, graph)) move(leaf, well);
  }

  void move(std::uint32_t leaf, std::uint32_t well) {
    const auto room = room_m3_.find(space_.groups.group_of_leaf[leaf]);
    if (room != room_m3_.end()) room->second -= volume_of(leaf);
    cutter_.assign(leaf, well);
  }

  CutSpace& space_;
  LeafCutter& cutter_;
  StairwellConfig config_;
  std::vector<Tread> treads_;       ///< from the lowest up
  std::vector<double> volumes_m3_;  ///< by leaf; below 0 until it is asked for
  std::map<std::uint32_t, double> room_m3_;
  BoxTree leaf_boxes_;     ///< by leaf; what is cut off later may be smaller than its box
  std::size_t boxed_ = 0;  ///< leaves in the tree
};

}  // namespace

void cut_stairwells(CutSpace& space, LeafCutter& cutter, const StairwellConfig& config) {
  StairwellFinder(space, cutter, config).run();
}

}  // namespace enfilade
