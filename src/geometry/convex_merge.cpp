#include "geometry/convex_merge.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace enfilade {
namespace {

struct SharedEdge {
  std::uint32_t from, to;  ///< as the first loop runs
  std::uint32_t first, second;
  double length;
};

struct DirectedEdge {
  std::uint32_t low, high, loop;
  bool forward;
};

std::vector<SharedEdge> shared_edges(const std::vector<Vec3>& points,
                                     const std::vector<IndexLoop>& loops) {
  std::vector<DirectedEdge> all;
  for (std::uint32_t l = 0; l < loops.size(); ++l) {
    for (std::size_t i = 0; i < loops[l].size(); ++i) {
      const std::uint32_t a = loops[l][i], b = loops[l][(i + 1) % loops[l].size()];
      all.push_back({std::min(a, b), std::max(a, b), l, a < b});
    }
  }
  std::sort(all.begin(), all.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
    return std::tie(a.low, a.high, a.loop) < std::tie(b.low, b.high, b.loop);
  });
  std::vector<SharedEdge> shared;
  for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
    while (end < all.size() && all[end].low == all[i].low && all[end].high == all[i].high) ++end;
    if (end - i != 2 || all[i].forward == all[i + 1].forward) continue;
    const auto [from, to] =
        all[i].forward ? std::pair{all[i].low, all[i].high} : std::pair{all[i].high, all[i].low};
    shared.push_back(
        {from, to, all[i].loop, all[i + 1].loop, glm::length(points[to] - points[from])});
  }
  std::stable_sort(shared.begin(), shared.end(),
                   [](const SharedEdge& a, const SharedEdge& b) { return a.length > b.length; });
  return shared;
}

// The loop, begun at `start`.
IndexLoop begun_at(IndexLoop loop, std::uint32_t start) {
  std::rotate(loop.begin(), std::find(loop.begin(), loop.end(), start), loop.end());
  return loop;
}

bool has_repeats(IndexLoop loop) {
  std::sort(loop.begin(), loop.end());
  return std::adjacent_find(loop.begin(), loop.end()) != loop.end();
}

bool is_convex(const std::vector<Vec3>& points, const IndexLoop& loop, double flat, double turn) {
  Polygon polygon;
  for (const std::uint32_t i : loop) polygon.push_back(points[i]);
  const Plane plane = plane_of(polygon);
  if (plane.n == Vec3(0.0)) return false;
  const Box box = bounds(polygon);
  const double rounding = 16.0 * 2.2e-16 * std::max(glm::length(box.lo), glm::length(box.hi));
  flat = std::min(flat, std::max(most_bend * box.diagonal(), rounding));
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (std::abs(plane.signed_distance(polygon[i])) > flat) return false;
    const Vec3 in = polygon[i] - polygon[(i + n - 1) % n], out = polygon[(i + 1) % n] - polygon[i];
    const double lengths = glm::length(in) * glm::length(out);
    if (glm::dot(glm::cross(in, out), plane.n) < -turn * lengths) return false;
    if (glm::dot(in, out) < -0.999999 * lengths) return false;  // folds back on itself
  }
  return true;
}

}  // namespace

std::vector<IndexLoop> merge_convex(const std::vector<Vec3>& points, std::vector<IndexLoop> loops,
                                    double flat_tolerance, double turn_tolerance) {
  std::vector<std::uint32_t> joined_to(loops.size());
  std::iota(joined_to.begin(), joined_to.end(), 0u);
  const auto root = [&](std::uint32_t l) {
    while (joined_to[l] != l) l = joined_to[l] = joined_to[joined_to[l]];
    return l;
  };
  for (const SharedEdge& edge : shared_edges(points, loops)) {
    const std::uint32_t a = root(edge.first), b = root(edge.second);
    if (a == b) continue;
    IndexLoop joined = begun_at(loops[a], edge.to);
    const IndexLoop other = begun_at(loops[b], edge.from);
    // A chain of several shared edges would leave a spike: such loops stay apart.
    if (joined.back() != edge.from || other.back() != edge.to) continue;
    joined.insert(joined.end(), other.begin() + 1, other.end() - 1);
    if (has_repeats(joined) || !is_convex(points, joined, flat_tolerance, turn_tolerance)) continue;
    loops[a] = std::move(joined);
    loops[b].clear();
    joined_to[b] = a;
  }
  std::erase_if(loops, [](const IndexLoop& loop) { return loop.empty(); });
  return loops;
}

}  // namespace enfilade
