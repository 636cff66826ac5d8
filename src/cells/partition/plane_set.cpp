// Planes by hashing; the dominant frame by the areas of the pieces' directions.
#include "cells/partition/plane_set.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace enfilade {
namespace {

constexpr double normal_steps = 64.0;      // of the grid over a unit normal's coordinates
constexpr double direction_steps = 256.0;  // likewise, where directions are collected

struct Key {
  std::int64_t x, y, z, d;
  bool operator==(const Key&) const = default;
};
struct KeyHash {
  std::size_t operator()(const Key& k) const {
    std::uint64_t h = 0;
    for (const std::int64_t v : {k.x, k.y, k.z, k.d}) {
      h = (h ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15ull;
      h ^= h >> 29;
    }
    return h;
  }
};

// Of two opposite normals one is canonical. Nearly equal planes have nearly equal canonical
// normals, but where the largest coordinate changes.
bool is_canonical(const Vec3& n) {
  const Vec3 a = glm::abs(n);
  const int k = a.x + 1e-6 >= a.y && a.x + 1e-6 >= a.z ? 0 : a.y + 1e-6 >= a.z ? 1 : 2;
  return n[k] > 0.0;
}

/// Areas by powers of 2^(1/steps). No area that is drawn, be it a power of two or its diagonal,
/// lies on a border between two classes, where rounding would decide.
double size_class(double area, double steps) { return std::floor(steps * std::log2(area) + 0.5); }

std::int64_t cell_of(double v) { return static_cast<std::int64_t>(std::floor(v)); }

/// Planes hashed by a grid over their canonical normals and their distances from the scene's
/// middle.
class PlaneIndex {
 public:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  PlaneIndex(std::vector<Plane>& planes, const Vec3& origin, double tolerance_m)
      : planes_(planes),
        origin_(origin),
        tolerance_m_(tolerance_m),
        distance_step_(8.0 * tolerance_m) {}

  /// The first plane that holds the polygon, whose own plane is given; none where there is none.
  std::uint32_t find(const Polygon& polygon, const Plane& plane) const {
    std::uint32_t found = none;
    // Only the cells within a quarter step of the value can hold an equal plane.
    const auto range = [&](double v) { return std::pair{cell_of(v - 0.25), cell_of(v + 0.25)}; };
    const Vec3 q = plane.n * normal_steps;
    const auto [x0, x1] = range(q.x);
    const auto [y0, y1] = range(q.y);
    const auto [z0, z1] = range(q.z);
    const auto [d0, d1] = range(distance_of(plane));
    for (auto x = x0; x <= x1; ++x) {
      for (auto y = y0; y <= y1; ++y) {
        for (auto z = z0; z <= z1; ++z) {
          for (auto d = d0; d <= d1; ++d) {
            found = std::min(found, find({x, y, z, d}, polygon, found));
          }
        }
      }
    }
    return found;
  }

  std::uint32_t add(const Plane& plane) {
    const auto number = static_cast<std::uint32_t>(planes_.size());
    planes_.push_back(plane);
    const Vec3 q = plane.n * normal_steps;
    buckets_[{cell_of(q.x), cell_of(q.y), cell_of(q.z), cell_of(distance_of(plane))}].push_back(
        number);
    return number;
  }

 private:
  double distance_of(const Plane& plane) const {
    return (plane.d - glm::dot(plane.n, origin_)) / distance_step_;
  }

  /// The first plane of a grid cell, below `limit`, that holds the polygon.
  std::uint32_t find(const Key& at, const Polygon& polygon, std::uint32_t limit) const {
    const auto bucket = buckets_.find(at);
    if (bucket == buckets_.end()) return none;
    for (const std::uint32_t candidate : bucket->second) {
      if (candidate < limit && lies_in(polygon, planes_[candidate], tolerance_m_)) return candidate;
    }
    return none;
  }

  std::vector<Plane>& planes_;
  Vec3 origin_;
  double tolerance_m_, distance_step_;
  std::unordered_map<Key, std::vector<std::uint32_t>, KeyHash> buckets_;
};

}  // namespace

PlaneSet find_planes(std::span<const Piece> pieces, double tolerance_m) {
  PlaneSet set;
  set.plane_of_piece.resize(pieces.size());
  set.same_facing.resize(pieces.size());
  Box box;
  std::vector<double> areas;
  for (const Piece& piece : pieces) {
    box.add(bounds(piece.polygon));
    areas.push_back(area_m2(piece.polygon));
  }
  // Large polygons first: their normals are the most precise.
  std::vector<std::size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Areas that are equal but for rounding stay in the file's order, however the building is turned.
  const auto size_of = [&](std::size_t i) { return size_class(areas[i], 16.0); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return size_of(a) > size_of(b); });
  PlaneIndex index(set.planes, pieces.empty() ? Vec3(0.0) : box.center(), tolerance_m);
  for (const std::size_t i : order) {
    const Polygon& polygon = pieces[i].polygon;
    Plane plane = plane_of(polygon);
    const bool canonical = is_canonical(plane.n);
    if (!canonical) plane = {-plane.n, -plane.d};
    std::uint32_t found = index.find(polygon, plane);
    if (found == PlaneIndex::none) found = index.add(plane);
    set.plane_of_piece[i] = found;
    const Vec3 n = canonical ? plane.n : -plane.n;
    set.same_facing[i] = glm::dot(n, set.planes[found].n) > 0.0;
  }
  return set;
}

namespace {

struct Direction {
  Vec3 n{0.0}, sum{0.0};
  double area = 0.0;
};

/// The directions of the pieces' normals, of either sign, the largest first.
std::vector<Direction> directions_of(std::span<const Piece> pieces) {
  std::vector<Direction> directions;
  std::unordered_map<Key, std::size_t, KeyHash> index;
  for (const Piece& piece : pieces) {
    Vec3 a = 0.5 * area_vector(piece.polygon);
    const double area = glm::length(a);
    if (area <= 0.0) continue;
    if (!is_canonical(a / area)) a = -a;
    const Vec3 q = a / area * direction_steps;
    std::size_t found = directions.size();
    for (int k = 0; k < 8 && found == directions.size(); ++k) {
      const Vec3 near(q.x + (k & 1 ? 0.25 : -0.25), q.y + (k & 2 ? 0.25 : -0.25),
                      q.z + (k & 4 ? 0.25 : -0.25));
      const auto at = index.find({cell_of(near.x), cell_of(near.y), cell_of(near.z), 0});
      if (at != index.end() &&
          glm::distance(directions[at->second].n * direction_steps, q) < 0.25) {
        found = at->second;
      }
    }
    if (found == directions.size()) {
      directions.push_back({a / area, Vec3(0.0), 0.0});
      index.try_emplace({cell_of(q.x), cell_of(q.y), cell_of(q.z), 0}, found);
    }
    directions[found].sum += a;
    directions[found].area += area;
  }
  // Largest first; what is equal but for rounding, in the file's order.
  std::stable_sort(directions.begin(), directions.end(),
                   [](const Direction& a, const Direction& b) {
                     return size_class(a.area, 64.0) > size_class(b.area, 64.0);
                   });
  return directions;
}

/// The axis or its opposite: that towards which most of the building's area lies.
Vec3 with_sign(const Vec3& axis, std::span<const Piece> pieces) {
  double low = 1e300, high = -1e300, sum = 0.0, whole = 0.0;
  for (const Piece& piece : pieces) {
    const double area = area_m2(piece.polygon);
    sum += area * glm::dot(axis, centroid(piece.polygon));
    whole += area;
    for (const Vec3& p : piece.polygon) {
      low = std::min(low, glm::dot(axis, p));
      high = std::max(high, glm::dot(axis, p));
    }
  }
  return sum >= 0.5 * (low + high) * whole ? axis : -axis;
}

}  // namespace

Frame dominant_frame(std::span<const Piece> pieces) {
  const std::vector<Direction> directions = directions_of(pieces);
  Frame frame{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  if (directions.empty()) return frame;
  frame[0] = with_sign(glm::normalize(directions[0].sum), pieces);
  Vec3 second(0.0);
  for (const Direction& direction : directions) {
    const Vec3 n = glm::normalize(direction.sum);
    if (std::abs(glm::dot(n, frame[0])) < 0.1) {
      second = n;
      break;
    }
  }
  if (second == Vec3(0.0)) {
    second = least_axis(frame[0]);
  }
  second = with_sign(glm::normalize(second - glm::dot(second, frame[0]) * frame[0]), pieces);
  frame[1] = second;
  frame[2] = glm::cross(frame[0], frame[1]);
  return frame;
}

}  // namespace enfilade
