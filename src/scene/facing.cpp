#include "scene/facing.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>

namespace enfilade {
namespace {

using Corner = std::array<std::int64_t, 3>;

struct Edge {
  std::uint32_t object;
  Corner low, high;
  std::uint32_t surface;
  bool forward;
};

std::vector<Edge> edges_of(const Scene& scene, const SceneScale& scale) {
  std::map<std::string, std::uint32_t> objects;
  std::vector<Edge> edges;
  const double cell = 4.0 * scale.cut();
  const auto corner = [&](const Vec3& p) {
    const Vec3 q = (p - scale.box().lo) / cell;
    return Corner{std::llround(q.x), std::llround(q.y), std::llround(q.z)};
  };
  for (std::uint32_t s = 0; s < scene.surfaces.size() && cell > 0.0; ++s) {
    const Surface& surface = scene.surfaces[s];
    if (surface.two_sided) continue;
    const std::uint32_t object =
        objects.try_emplace(surface.object, static_cast<std::uint32_t>(objects.size()))
            .first->second;
    for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
      const Corner a = corner(surface.vertices[i]),
                   b = corner(surface.vertices[(i + 1) % surface.vertices.size()]);
      if (a != b) edges.push_back({object, std::min(a, b), std::max(a, b), s, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.object, a.low, a.high, a.surface) <
           std::tie(b.object, b.low, b.high, b.surface);
  });
  return edges;
}

// Disjoint sets in which every member knows whether it faces like the root or against it.
class Shells {
 public:
  explicit Shells(std::size_t count)
      : parent_(count), against_(count, false), bad_(count, false), shared_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  std::uint32_t root(std::uint32_t s, bool& against) const {
    against = false;
    for (; parent_[s] != s; s = parent_[s]) against ^= against_[s];
    return s;
  }

  void join(std::uint32_t a, std::uint32_t b, bool opposite) {
    ++shared_[a];
    ++shared_[b];
    bool against_a = false, against_b = false;
    std::uint32_t ra = root(a, against_a), rb = root(b, against_b);
    const bool flip = against_a ^ against_b ^ opposite;
    if (ra == rb) {
      if (flip) bad_[ra] = true;
      return;
    }
    if (size(ra) < size(rb)) std::swap(ra, rb);
    parent_[rb] = ra;
    against_[rb] = flip;
    if (bad_[rb]) bad_[ra] = true;
    sizes_[ra] = size(ra) + size(rb);
  }

  bool inconsistent(std::uint32_t r) const { return bad_[r]; }
  std::uint32_t shared_edges(std::uint32_t s) const { return shared_[s]; }

 private:
  std::uint32_t size(std::uint32_t r) const {
    const auto it = sizes_.find(r);
    return it == sizes_.end() ? 1 : it->second;
  }
  std::vector<std::uint32_t> parent_;
  std::vector<bool> against_, bad_;
  std::vector<std::uint32_t> shared_;
  std::map<std::uint32_t, std::uint32_t> sizes_;
};

}  // namespace

std::vector<SurfaceId> reversed_surfaces(const Scene& scene, const SceneScale& scale) {
  const std::vector<Edge> edges = edges_of(scene, scale);
  const auto count = static_cast<std::uint32_t>(scene.surfaces.size());
  Shells shells(count);
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end].object == edges[i].object &&
           edges[end].low == edges[i].low && edges[end].high == edges[i].high)
      ++end;
    const bool two = end - i == 2 && edges[i].surface != edges[i + 1].surface;
    if (two)
      shells.join(edges[i].surface, edges[i + 1].surface, edges[i].forward == edges[i + 1].forward);
  }
  // Per shell: how many face like its root, and how many against it.
  std::map<std::uint32_t, std::array<std::uint32_t, 2>> facing;
  bool against = false;
  for (std::uint32_t s = 0; s < count; ++s) {
    const std::uint32_t r = shells.root(s, against);
    ++facing[r][against ? 1 : 0];
  }
  std::vector<SurfaceId> reversed;
  for (std::uint32_t s = 0; s < count; ++s) {
    const std::uint32_t r = shells.root(s, against);
    const std::uint32_t mine = facing[r][against ? 1 : 0], others = facing[r][against ? 0 : 1];
    const bool enclosed = 2 * shells.shared_edges(s) >= scene.surfaces[s].vertices.size();
    if (!shells.inconsistent(r) && enclosed && others >= 3 && 2 * mine < others)
      reversed.emplace_back(s);
  }
  return reversed;
}

}  // namespace enfilade
