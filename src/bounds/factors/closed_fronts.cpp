#include "bounds/factors/closed_fronts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/box_tree.hpp"
#include "geometry/clip.hpp"
#include "geometry/form_factor.hpp"

namespace enfilade {
namespace {

/// All polygons with their planes and a search by place.
struct Shell {
  std::span<const Polygon> polygons;
  double tolerance_m;
  std::vector<Plane> planes;
  std::vector<Box> boxes;
  BoxTree tree;

  Shell(std::span<const Polygon> all, double tolerance) : polygons(all), tolerance_m(tolerance) {
    for (const Polygon& polygon : polygons) {
      planes.push_back(plane_of(polygon));
      boxes.push_back(bounds(polygon));
    }
    tree = BoxTree(boxes);
  }
};

/// Does the edge a-b, with all edges along it in the polygons `among`, cancel everywhere? Counted
/// along its line: 1 for an edge in its direction, -1 for one against it.
bool edge_cancels(const Shell& shell, const Vec3& a, const Vec3& b,
                  const std::vector<std::uint32_t>& among) {
  const double length = glm::length(b - a);
  if (length <= shell.tolerance_m) return true;
  const Vec3 along = (b - a) / length;
  std::vector<std::pair<double, int>> changes;
  for (const std::uint32_t k : among) {
    const Polygon& p = shell.polygons[k];
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3 c = p[i] - a, d = p[(i + 1) % p.size()] - a;
      const double at_c = glm::dot(along, c), at_d = glm::dot(along, d);
      if (glm::length(c - at_c * along) > shell.tolerance_m ||
          glm::length(d - at_d * along) > shell.tolerance_m)
        continue;
      const double from = std::clamp(at_c, 0.0, length), to = std::clamp(at_d, 0.0, length);
      changes.emplace_back(from, 1);
      changes.emplace_back(to, -1);
    }
  }
  std::sort(changes.begin(), changes.end());
  int count = 0;
  double open_since = 0.0;
  for (const auto& [at, change] : changes) {
    if (count != 0 && at - open_since > 4.0 * shell.tolerance_m) return false;
    if (count == 0 || at > open_since) open_since = at;
    count += change;
  }
  return true;
}

bool edges_cancel(const Shell& shell) {
  for (const Polygon& p : shell.polygons) {
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3 &a = p[i], &b = p[(i + 1) % p.size()];
      Box box;
      box.add(a);
      box.add(b);
      if (!edge_cancels(shell, a, b, shell.tree.touching(box, shell.tolerance_m))) return false;
    }
  }
  return true;
}

/// Does polygon p pass through the inside of polygon q?
bool passes_through(const Shell& shell, std::uint32_t p, std::uint32_t q) {
  const Plane& plane = shell.planes[q];
  const DistanceRange range = distances(shell.polygons[p], plane);
  if (range.lowest >= -shell.tolerance_m || range.highest <= shell.tolerance_m) return false;
  std::vector<Vec3> ends;
  const Polygon& corners = shell.polygons[p];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double at_a = plane.signed_distance(a), at_b = plane.signed_distance(b);
    if ((at_a < 0.0) != (at_b < 0.0)) ends.push_back(zero_crossing(a, at_a, b, at_b));
  }
  if (ends.size() < 2) return false;
  Segment cut{ends[0], ends[1]};
  for (const Plane& edge : edge_planes(shell.polygons[q], plane.n, 0.0)) {
    const Plane inner{-edge.n, -edge.d + 2.0 * shell.tolerance_m};
    if (!clip_front(cut, inner, 0.0)) return false;
  }
  return cut.length_m() > 4.0 * shell.tolerance_m;
}

/// Solid angles of all polygons from a point, positive for fronts, over 4 pi.
double winding(const Shell& shell, const Vec3& p) {
  double sum = 0.0;
  for (std::size_t k = 0; k < shell.polygons.size(); ++k) {
    const double height = shell.planes[k].signed_distance(p);
    if (height != 0.0) sum += std::copysign(solid_angle(p, shell.polygons[k]), height);
  }
  return sum / (4.0 * std::numbers::pi);
}

/// The parts of a polygon that have the same polygons of its plane behind them.
std::vector<Polygon> parts_by_neighbours(const Shell& shell, std::uint32_t k,
                                         const std::vector<std::uint32_t>& near) {
  std::vector<Polygon> parts{shell.polygons[k]};
  for (const std::uint32_t q : near) {
    if (q == k || !lies_in(shell.polygons[q], shell.planes[k], 4.0 * shell.tolerance_m)) continue;
    std::vector<Polygon> next;
    for (const Polygon& part : parts) {
      for (Polygon& rest : subtract_coplanar(part, shell.polygons[q], 4.0 * shell.tolerance_m))
        next.push_back(std::move(rest));
      Polygon common = intersect_coplanar(part, shell.polygons[q], 4.0 * shell.tolerance_m);
      if (common.size() >= 3) next.push_back(std::move(common));
    }
    parts = std::move(next);
  }
  return parts;
}

/// The winding number before the front of each part of a polygon, if all have the same; -1 if not.
int front_winding(const Shell& shell, std::uint32_t k, const std::vector<std::uint32_t>& near) {
  int found = -2;
  for (const Polygon& part : parts_by_neighbours(shell, k, near)) {
    const double inner = std::sqrt(area_m2(part));
    if (inner <= 100.0 * shell.tolerance_m) continue;
    const Vec3 p =
        centroid(part) + std::min(8.0 * shell.tolerance_m, 1e-3 * inner) * shell.planes[k].n;
    const double w = winding(shell, p);
    const int whole = static_cast<int>(std::lround(w));
    if (std::abs(w - whole) > 1e-3 || (found != -2 && found != whole)) return -1;
    found = whole;
  }
  return found == -2 ? 0 : found;
}

}  // namespace

ClosedFronts closed_fronts(std::span<const Polygon> polygons, std::span<const Vec3> points,
                           double tolerance_m, std::size_t most) {
  ClosedFronts none{std::vector<char>(polygons.size(), 0), std::vector<char>(points.size(), 0)};
  if (polygons.empty() || polygons.size() > most) return none;
  const Shell shell(polygons, tolerance_m);
  if (!edges_cancel(shell)) return none;
  ClosedFronts found = none;
  for (std::uint32_t k = 0; k < polygons.size(); ++k) {
    const std::vector<std::uint32_t> near = shell.tree.touching(shell.boxes[k], tolerance_m);
    for (const std::uint32_t q : near) {
      if (q != k && passes_through(shell, k, q)) return none;
    }
    const int w = front_winding(shell, k, near);
    if (w != 0 && w != 1) return none;
    found.polygons[k] = w == 1;
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    found.points[i] = std::abs(winding(shell, points[i]) - 1.0) < 1e-3;
  return found;
}

}  // namespace enfilade
