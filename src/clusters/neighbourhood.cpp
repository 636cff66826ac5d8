// Union-find over shared vertices; halving by position.
#include "clusters/neighbourhood.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

namespace enfilade {
namespace {

using GridPoint = std::array<std::int64_t, 3>;

std::size_t find(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

std::vector<Group> connected_groups(std::span<const Polygon* const> polygons, double tolerance_m) {
  std::vector<std::size_t> parent(polygons.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  Box box;
  for (const Polygon* polygon : polygons) box.add(bounds(*polygon));
  std::map<GridPoint, std::size_t> first_at;
  // A vertex near a border of its grid cell is entered on both sides of it.
  const double step = 8.0 * std::max(tolerance_m, 1e-300);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    for (const Vec3& p : *polygons[i]) {
      const Vec3 q = (p - box.lo) / step;
      for (int corner = 0; corner < 8; ++corner) {
        GridPoint at{};
        for (int k = 0; k < 3; ++k) {
          const double nudge = (corner >> k) & 1 ? 0.0625 : -0.0625;
          at[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(q[k] + nudge));
        }
        const std::size_t other = first_at.try_emplace(at, i).first->second;
        const std::size_t a = find(parent, i), b = find(parent, other);
        parent[std::max(a, b)] = std::min(a, b);
      }
    }
  }
  std::map<std::size_t, Group> groups;
  for (std::size_t i = 0; i < polygons.size(); ++i) groups[find(parent, i)].push_back(i);
  std::vector<Group> result;
  for (auto& [root, group] : groups) result.push_back(std::move(group));
  return result;
}

std::vector<Group> split_by_position(std::span<const Polygon* const> polygons, Group group,
                                     std::size_t max_size, double max_extent_m) {
  std::vector<Group> done, jobs{std::move(group)};
  while (!jobs.empty()) {
    Group job = std::move(jobs.back());
    jobs.pop_back();
    Box box;
    for (const std::size_t i : job) box.add(bounds(*polygons[i]));
    // Extents that are equal but for rounding count as equal, so that a turned building is halved
    // along the same axis.
    const Vec3 e = box.extent();
    const double widest = (1.0 - 1e-9) * std::max({e.x, e.y, e.z});
    const int axis = e.x >= widest ? 0 : e.y >= widest ? 1 : 2;
    const bool too_long = max_extent_m > 0.0 && e[axis] > (1.0 + 1e-9) * max_extent_m;
    if (job.size() <= 1 || (job.size() <= max_size && !too_long)) {
      done.push_back(std::move(job));
      continue;
    }
    const auto along = [&](std::size_t i) {
      const double share = (bounds(*polygons[i]).center()[axis] - box.lo[axis]) / e[axis];
      return std::floor(1e6 * share + 0.3);  // no fraction of small numbers lies on a border
    };
    std::stable_sort(job.begin(), job.end(),
                     [&](std::size_t a, std::size_t b) { return along(a) < along(b); });
    const auto middle = job.begin() + static_cast<std::ptrdiff_t>(job.size() / 2);
    jobs.emplace_back(job.begin(), middle);
    jobs.emplace_back(middle, job.end());
  }
  return done;
}

}  // namespace enfilade
