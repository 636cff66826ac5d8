// Openings between rooms and the outside are measured, and the largest of each kind is reported.
#include "cells/rooms/leaks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "cells/rooms/leak_paths.hpp"

namespace enfilade {
namespace {

/// Distance of the nearest two parallel lines, one along an edge, that hold the polygon.
double width_of(const Polygon& polygon) {
  const Vec3 n = normal(polygon);
  double least = 1e300;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double length = glm::length(edge);
    if (length <= 0.0) continue;
    const Vec3 across = glm::cross(n, edge / length);
    double most = 0.0;
    for (const Vec3& p : polygon) most = std::max(most, std::abs(glm::dot(across, p - polygon[i])));
    least = std::min(least, most);
  }
  return least;
}

/// The open part of a portal, which is the hull of it.
struct Opening {
  const Portal* portal = nullptr;
  double open_m2 = 0.0;
  double width_m = 0.0;  ///< of a ring: the width of its parts
  Vec3 middle{0.0};      ///< centroid of its largest part
  double framed = 0.0;   ///< framed share of all openings between its cells in its plane
};

class LeakFinder {
 public:
  LeakFinder(const CutSpace& space, const LeafCutter& cutter, std::span<const Portal> portals,
             const Region& border, std::span<const char> touches_border, const LeakConfig& config)
      : space_(space),
        cutter_(cutter),
        portals_(portals),
        border_(border),
        touches_border_(touches_border),
        config_(config),
        paths_(space, cutter, touches_border) {
    for (const LeafInterface& face : space.interfaces) {
      const std::uint32_t a = space.groups.group_of_leaf[face.front_leaf];
      const std::uint32_t b = space.groups.group_of_leaf[face.back_leaf];
      if (a != b && !face.openings.empty()) faces_between_[{a, b}].push_back(&face);
    }
  }

  std::vector<Leak> run(std::span<const std::uint32_t> lost) {
    std::map<std::pair<std::uint32_t, LeakKind>, const Opening*> worst;
    const std::map<std::uint32_t, std::vector<Opening>> by_room = to_outside();
    for (const auto& [room, openings] : by_room) {
      for (const Opening& opening : openings) {
        const auto leak = kind_of(opening, room);
        if (!leak || (*leak == LeakKind::gap && is_beside_window(opening, room, openings))) {
          continue;
        }
        const Opening*& now = worst[{room, *leak}];
        if (now == nullptr || opening.open_m2 > now->open_m2) now = &opening;
      }
    }
    std::vector<Leak> found;
    for (const auto& [key, opening] : worst) {
      const CellId room(key.first);
      found.push_back({key.second, room, opening->open_m2, opening->width_m,
                       paths_.through(*opening->portal, opening->middle, room)});
    }
    std::vector<std::uint32_t> all_lost(lost.begin(), lost.end());
    for (const std::uint32_t leaf : enclosed_at_border()) all_lost.push_back(leaf);
    for (const std::uint32_t leaf : all_lost) found.push_back(lost_room(leaf));
    return found;
  }

 private:
  Leak lost_room(std::uint32_t leaf) const {
    Leak leak{LeakKind::lost_room, CellId(space_.groups.group_of_leaf[leaf]), 0.0, 0.0, {}};
    leak.path.push_back(middle_of(space_.tree.leaves[leaf]));
    const Facet* missing = largest_on_border(space_.tree.leaves[leaf], border_);
    if (missing == nullptr) {
      paths_.add_way_out(leaf, leak.path);
      return leak;
    }
    leak.area_m2 = area_m2(missing->polygon);
    leak.width_m = width_of(missing->polygon);
    leak.path.push_back(centroid(missing->polygon));
    return leak;
  }

  /// Leaves at the border (outside, therefore) that would be rooms if they did not lack a wall; of
  /// leaves that are open to each other the first.
  std::vector<std::uint32_t> enclosed_at_border() const {
    std::vector<double> front(space_.tree.leaves.size(), 0.0);
    for (const LeafInterface& face : space_.interfaces) {
      front[face.front_leaf] += face.faces_front_m2;
      front[face.back_leaf] += face.faces_back_m2;
    }
    const double least_m3 = config_.border_room_share * median_room_m3();
    std::vector<std::uint32_t> found;
    for (std::uint32_t leaf = 0; leaf < front.size(); ++leaf) {
      const Region& region = space_.tree.leaves[leaf];
      if (!touches_border_[leaf] || front[leaf] <= 0.0 || volume_m3(region) < least_m3) continue;
      double boundary = 0.0;
      for (const Facet& facet : region.facets) boundary += area_m2(facet.polygon);
      if (front[leaf] < config_.border_front_share * boundary) continue;
      const auto& interfaces = cutter_.interfaces_of(leaf);
      const bool is_known = std::ranges::any_of(interfaces, [&](std::uint32_t i) {
        const LeafInterface& face = space_.interfaces[i];
        const std::uint32_t other = face.other_than(leaf);
        return face.open_m2 > 0.0 && std::ranges::find(found, other) != found.end();
      });
      if (!is_known) found.push_back(leaf);
    }
    return found;
  }

  double median_room_m3() const {
    std::vector<double> rooms;
    for (std::uint32_t group = 0; group < space_.groups.kinds.size(); ++group) {
      if (kind(CellId(group)) == CellKind::room) rooms.push_back(volume(group));
    }
    if (rooms.empty()) return 0.0;
    const auto middle = rooms.begin() + static_cast<std::ptrdiff_t>(rooms.size() / 2);
    std::nth_element(rooms.begin(), middle, rooms.end());
    return *middle;
  }

  std::map<std::uint32_t, std::vector<Opening>> to_outside() const {
    std::map<std::uint32_t, std::vector<Opening>> by_room;
    for (const Portal& portal : portals_) {
      const CellKind a = kind(portal.a), b = kind(portal.b);
      if ((a == CellKind::outside) == (b == CellKind::outside)) continue;
      const CellId room = a == CellKind::outside ? portal.b : portal.a;
      if (kind(room) == CellKind::room) by_room[room.value].push_back(opening_of(portal));
    }
    return by_room;
  }

  /// The chinks of a window's frame are not reported: a window leaks anyway.
  bool is_beside_window(const Opening& gap, std::uint32_t room,
                        const std::vector<Opening>& others) const {
    const Box box = bounds(gap.portal->polygon);
    const double near_m = 0.05 * std::cbrt(volume(room));
    return std::ranges::any_of(others, [&](const Opening& other) {
      return other.width_m > 2.0 * gap.width_m &&
             bounds(other.portal->polygon).overlaps(box, near_m) &&
             kind_of(other, room) != LeakKind::gap;
    });
  }

  CellKind kind(CellId cell) const { return space_.groups.kinds[cell.index()]; }

  Opening opening_of(const Portal& portal) const {
    const Box box = bounds(portal.polygon);
    const Plane plane = plane_of(portal.polygon);
    Opening opening;
    opening.portal = &portal;
    opening.middle = centroid(portal.polygon);
    double open = 0.0, framed = 0.0, largest = 0.0, widest_m = 0.0;
    for (const LeafInterface* face : faces_between_.at({portal.a.value, portal.b.value})) {
      const Plane& other = space_.planes.planes[face->plane];
      if (std::abs(glm::dot(other.n, plane.n)) < 1.0 - 1e-9) continue;
      if (std::abs(other.signed_distance(portal.polygon[0])) > space_.tolerance_m) continue;
      open += face->open_m2;
      framed += face->framed_m2;
      for (const Polygon& part : face->openings) {
        if (!box.overlaps(bounds(part))) continue;
        const double area = area_m2(part);
        opening.open_m2 += area;
        widest_m = std::max(widest_m, width_of(part));
        if (area <= largest) continue;
        largest = area;
        opening.middle = centroid(part);
      }
    }
    opening.framed = open > 0.0 ? framed / open : 0.0;
    opening.width_m = width_of(portal.polygon);
    if (2.0 * opening.open_m2 < area_m2(portal.polygon)) {
      opening.width_m = std::min(opening.width_m, widest_m);
    }
    return opening;
  }

  std::optional<LeakKind> kind_of(const Opening& opening, std::uint32_t room) const {
    const double size_m = std::cbrt(volume(room)), planes_apart_m = 2.0 * space_.tolerance_m;
    if (opening.width_m <= planes_apart_m) return std::nullopt;
    if (opening.width_m < config_.gap_share * size_m) return LeakKind::gap;
    const double area = area_m2(opening.portal->polygon);
    if (area < config_.side_share * size_m * size_m) return std::nullopt;
    if (opening.framed < config_.framed_share) return LeakKind::open_side;
    return std::nullopt;
  }

  double volume(std::uint32_t group) const {
    auto [at, is_new] = volumes_.try_emplace(group, 0.0);
    if (is_new) {
      for (const std::uint32_t leaf : cutter_.leaves_of(group)) {
        at->second += volume_m3(space_.tree.leaves[leaf]);
      }
    }
    return at->second;
  }

  const CutSpace& space_;
  const LeafCutter& cutter_;
  std::span<const Portal> portals_;
  const Region& border_;
  std::span<const char> touches_border_;
  LeakConfig config_;
  LeakPaths paths_;
  /// With openings, by group in front and group behind.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<const LeafInterface*>>
      faces_between_;
  mutable std::map<std::uint32_t, double> volumes_;
};

}  // namespace

const char* name_of(LeakKind kind) {
  switch (kind) {
    case LeakKind::gap:
      return "gap";
    case LeakKind::open_side:
      return "open side";
    case LeakKind::lost_room:
      break;
  }
  return "lost room";
}

std::vector<Leak> find_leaks(const CutSpace& space, const LeafCutter& cutter,
                             std::span<const Portal> portals, const Region& border,
                             std::span<const char> touches_border,
                             std::span<const std::uint32_t> lost, const LeakConfig& config) {
  return LeakFinder(space, cutter, portals, border, touches_border, config).run(lost);
}

}  // namespace enfilade
