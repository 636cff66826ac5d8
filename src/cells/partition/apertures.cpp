// Openings of one plane that touch are joined, and the rim of each such aperture is walked.
#include "cells/partition/apertures.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/box_tree.hpp"

namespace enfilade {
namespace {

struct Opening {
  const Polygon* polygon;
  Box box;
  std::uint32_t interface;
  Vec3 n;  ///< by the polygon's own order of vertices
};

/// The openings of one cut, joined by union-find into apertures.
class Apertures {
 public:
  Apertures(std::span<LeafInterface> faces, const BspCut& cut,
            const std::vector<std::vector<std::uint32_t>>& neighbours, double tolerance_m)
      : faces_(faces), cut_(cut), neighbours_(neighbours), reach_m_(4.0 * tolerance_m) {
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
      for (const Polygon& p : faces[i].openings) {
        openings_.push_back({&p, bounds(p), i, normal(p)});
        opening_tree_.add(openings_.back().box);
      }
    }
    for (const InPlane& c : cut.covered_by) {
      cover_normals_.push_back(normal(c.polygon));
      cover_tree_.add(c.box);
    }
    parent_.resize(openings_.size());
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  void measure() {
    connect();
    std::vector<double> rim(openings_.size(), 0.0), framed(openings_.size(), 0.0);
    for (std::uint32_t i = 0; i < openings_.size(); ++i) walk_rim(i, rim, framed);
    for (std::uint32_t i = 0; i < openings_.size(); ++i) {
      const std::uint32_t whole = find(i);
      if (rim[whole] <= 0.0) continue;
      faces_[openings_[i].interface].framed_m2 +=
          area_m2(*openings_[i].polygon) * framed[whole] / rim[whole];
    }
  }

 private:
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  bool joined(std::uint32_t a, std::uint32_t b) const {
    return a == b || std::binary_search(neighbours_[a].begin(), neighbours_[a].end(), b);
  }
  void connect() {
    for (std::uint32_t i = 0; i < openings_.size(); ++i) {
      for (const std::uint32_t j : opening_tree_.touching(openings_[i].box, reach_m_)) {
        if (j <= i) continue;
        const LeafInterface& a = faces_[openings_[i].interface];
        const LeafInterface& b = faces_[openings_[j].interface];
        if (joined(a.front_leaf, b.front_leaf) && joined(a.back_leaf, b.back_leaf)) {
          parent_[find(i)] = find(j);
        }
      }
    }
  }
  bool is_open(const Vec3& p) const {
    return opening_tree_.any_touching({p, p}, 0.1 * reach_m_, [&](std::uint32_t i) {
      return contains(*openings_[i].polygon, openings_[i].n, p);
    });
  }
  bool is_covered(const Vec3& p) const {
    return cover_tree_.any_touching({p, p}, reach_m_, [&](std::uint32_t k) {
      return contains(cut_.covered_by[k].polygon, cover_normals_[k], p);
    });
  }
  /// Tests points just beyond the opening's rim: each is open again, covered, or neither. Adds the
  /// rim's length that is not open to `rim`, of that the length that is covered to `framed`.
  void walk_rim(std::uint32_t i, std::vector<double>& rim, std::vector<double>& framed) {
    const Opening& o = openings_[i];
    const std::uint32_t whole = find(i);
    const Polygon& p = *o.polygon;
    for (std::size_t e = 0; e < p.size(); ++e) {
      const Vec3 a = p[e], along = p[(e + 1) % p.size()] - a;
      const double length = glm::length(along);
      if (length <= reach_m_) continue;
      const Vec3 out = glm::cross(along / length, o.n) * reach_m_;
      constexpr int steps = 8;  // points tested along an edge
      for (int k = 0; k < steps; ++k) {
        const Vec3 q = a + (k + 0.5) / steps * along + out;
        if (is_open(q)) continue;
        rim[whole] += length / steps;
        if (is_covered(q)) framed[whole] += length / steps;
      }
    }
  }

  std::span<LeafInterface> faces_;
  const BspCut& cut_;
  const std::vector<std::vector<std::uint32_t>>& neighbours_;
  double reach_m_;
  std::vector<Opening> openings_;
  std::vector<Vec3> cover_normals_;
  BoxTree opening_tree_, cover_tree_;
  std::vector<std::uint32_t> parent_;
};

}  // namespace

void frame_apertures(std::span<LeafInterface> interfaces, const BspTree& tree, double tolerance_m) {
  std::vector<std::vector<std::uint32_t>> neighbours(tree.leaves.size());
  for (const LeafInterface& face : interfaces) {
    if (face.open_m2 < 0.5 * face.area_m2) continue;
    neighbours[face.front_leaf].push_back(face.back_leaf);
    neighbours[face.back_leaf].push_back(face.front_leaf);
  }
  for (auto& list : neighbours) std::sort(list.begin(), list.end());
  for (std::size_t begin = 0, end = 0; begin < interfaces.size(); begin = end) {
    while (end < interfaces.size() && interfaces[end].cut == interfaces[begin].cut) ++end;
    Apertures(interfaces.subspan(begin, end - begin), tree.cuts[interfaces[begin].cut], neighbours,
              tolerance_m)
        .measure();
  }
}

}  // namespace enfilade
