// Openings of one plane that touch are joined, and the rim of each such aperture is walked.
#include "cells/partition/apertures.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/box_tree.hpp"

namespace enfilade {
namespace {

/// A part of an aperture: an opening of an interface, or the section of a leaf across the plane.
struct Opening {
  static constexpr std::uint32_t none = 0xFFFFFFFFu;
  Polygon polygon;
  Box box;
  std::uint32_t front_leaf, back_leaf;
  std::uint32_t interface = none;
  Vec3 n;  ///< by the polygon's own order of vertices
};

/// The openings of one plane, joined by union-find into apertures.
class Apertures {
 public:
  Apertures(const std::vector<std::vector<std::uint32_t>>& neighbours, const BspTree& tree,
            const Vec3& n, double tolerance_m)
      : neighbours_(neighbours), tree_(tree), n_(n), reach_m_(4.0 * tolerance_m) {}

  void add_opening(const Polygon& p, const LeafInterface& face, std::uint32_t number) {
    add({p, bounds(p), face.front_leaf, face.back_leaf, number, normal(p)});
  }
  void add_section(Polygon p, std::uint32_t leaf) {
    const Box box = bounds(p);
    const Vec3 n = normal(p);
    add({std::move(p), box, leaf, leaf, Opening::none, n});
  }
  void add_cover(const InPlane& cover) {
    covers_.push_back(&cover);
    cover_normals_.push_back(normal(cover.polygon));
  }

  void measure() {
    parent_.resize(openings_.size());
    std::iota(parent_.begin(), parent_.end(), 0u);
    std::vector<Box> opening_boxes, cover_boxes;
    for (const Opening& opening : openings_) opening_boxes.push_back(opening.box);
    for (const InPlane* cover : covers_) cover_boxes.push_back(cover->box);
    opening_tree_ = BoxTree(opening_boxes);
    cover_tree_ = BoxTree(cover_boxes);
    connect();
    rim_m_.assign(openings_.size(), 0.0);
    framed_m_.assign(openings_.size(), 0.0);
    std::vector<char> near_cover(openings_.size(), 0);
    for (std::uint32_t i = 0; i < openings_.size(); ++i) {
      char& near = near_cover[find(i)];
      near = near || !cover_tree_.touching(openings_[i].box, 2.0 * reach_m_).empty();
    }
    for (std::uint32_t i = 0; i < openings_.size(); ++i) {
      if (near_cover[find(i)]) walk_rim(i);
    }
  }

  const std::vector<Opening>& openings() const { return openings_; }
  /// The share of the rim of an opening's aperture that is framed.
  double framed_share(std::uint32_t opening) const {
    const std::uint32_t whole = find(opening);
    return rim_m_[whole] > 0.0 ? framed_m_[whole] / rim_m_[whole] : 0.0;
  }

 private:
  void add(Opening opening) { openings_.push_back(std::move(opening)); }
  std::uint32_t find(std::uint32_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  bool joined(std::uint32_t a, std::uint32_t b) const {
    return a == b || std::binary_search(neighbours_[a].begin(), neighbours_[a].end(), b);
  }
  void connect() {
    for (std::uint32_t i = 0; i < openings_.size(); ++i) {
      const Opening& a = openings_[i];
      for (const std::uint32_t j : opening_tree_.touching(a.box, reach_m_)) {
        if (j <= i) continue;
        const Opening& b = openings_[j];
        if (joined(a.front_leaf, b.front_leaf) && joined(a.back_leaf, b.back_leaf)) {
          const std::uint32_t root = find(i), other = find(j);
          parent_[std::max(root, other)] = std::min(root, other);
        }
      }
    }
    // A parent is never above its child, so that one pass leads all to their roots.
    for (std::uint32_t i = 0; i < parent_.size(); ++i) parent_[i] = parent_[parent_[i]];
  }
  /// Openings of one aperture, and covers, that a part of its rim may run into. An opening beyond a
  /// wall that stands on the plane is of another aperture.
  struct Near {
    std::vector<std::uint32_t> openings, covers;
  };
  Near near_rim(const Opening& opening, std::uint32_t whole) const {
    Near found{opening_tree_.touching(opening.box, reach_m_ + open_margin_m()),
               cover_tree_.touching(opening.box, 2.0 * reach_m_)};
    std::erase_if(found.openings, [&](std::uint32_t i) { return find(i) != whole; });
    return found;
  }
  /// Replaces `found` by those of `rim` that an edge may run into.
  void narrow(const Near& rim, const Box& edge, Near& found) const {
    found.openings.clear();
    found.covers.clear();
    for (const std::uint32_t i : rim.openings) {
      if (openings_[i].box.overlaps(edge, open_margin_m())) found.openings.push_back(i);
    }
    for (const std::uint32_t k : rim.covers) {
      if (covers_[k]->box.overlaps(edge, reach_m_)) found.covers.push_back(k);
    }
  }
  double open_margin_m() const { return 0.1 * reach_m_; }
  bool is_open(const Vec3& p, const Near& near) const {
    return std::any_of(near.openings.begin(), near.openings.end(), [&](std::uint32_t i) {
      const Opening& o = openings_[i];
      return o.box.overlaps({p, p}, open_margin_m()) && contains(o.polygon, o.n, p);
    });
  }
  bool is_covered(const Vec3& p, const Near& near) const {
    return std::any_of(near.covers.begin(), near.covers.end(), [&](std::uint32_t k) {
      return covers_[k]->box.overlaps({p, p}, reach_m_) &&
             contains(covers_[k]->polygon, cover_normals_[k], p);
    });
  }
  /// True where a polygon that covers p, beside the opening, borders on what lies before or behind
  /// the opening: a wall, and not a joint within a floor.
  bool is_frame(const Vec3& p, const Opening& opening) const {
    return joined(leaf_at(p + reach_m_ * n_), opening.front_leaf) ||
           joined(leaf_at(p - reach_m_ * n_), opening.back_leaf);
  }
  std::uint32_t leaf_at(const Vec3& p) const {
    const BspNode* node = &tree_.nodes.front();
    while (node->front >= 0) {
      const bool in_front = node->plane.signed_distance(p) >= 0.0;
      node = &tree_.nodes[static_cast<std::size_t>(in_front ? node->front : node->back)];
    }
    return node->cell.value;
  }
  /// Tests points just beyond the opening's rim: each is open again, a frame, or neither.
  void walk_rim(std::uint32_t i) {
    const Opening& o = openings_[i];
    const std::uint32_t whole = find(i);
    const Polygon& p = o.polygon;
    const Near rim = near_rim(o, whole);
    Near near;
    for (std::size_t e = 0; e < p.size(); ++e) {
      const Vec3 a = p[e], along = p[(e + 1) % p.size()] - a;
      const double length = glm::length(along);
      if (length <= reach_m_) continue;
      const Vec3 out = glm::cross(along / length, o.n) * reach_m_;
      Box edge;
      edge.add(a + out);
      edge.add(a + along + out);
      narrow(rim, edge, near);
      constexpr int steps = 8;  // points tested along an edge
      for (int k = 0; k < steps; ++k) {
        const Vec3 q = a + (k + 0.5) / steps * along + out;
        if (is_open(q, near)) continue;
        rim_m_[whole] += length / steps;
        if (is_covered(q, near) && is_frame(q, o)) framed_m_[whole] += length / steps;
      }
    }
  }

  const std::vector<std::vector<std::uint32_t>>& neighbours_;
  const BspTree& tree_;
  Vec3 n_;  ///< of the plane
  double reach_m_;
  std::vector<Opening> openings_;
  std::vector<const InPlane*> covers_;
  std::vector<Vec3> cover_normals_;
  BoxTree opening_tree_, cover_tree_;
  std::vector<std::uint32_t> parent_;
  std::vector<double> rim_m_, framed_m_;  ///< by the first opening of an aperture: length that is
                                          ///< not open again, and of that what is framed
};

/// The leaves that are open to each leaf over at least half of their common face, ascending.
std::vector<std::vector<std::uint32_t>> open_neighbours(std::span<const LeafInterface> interfaces,
                                                        std::size_t leaves) {
  std::vector<std::vector<std::uint32_t>> neighbours(leaves);
  for (const LeafInterface& face : interfaces) {
    if (face.open_m2 < 0.5 * face.area_m2) continue;
    neighbours[face.front_leaf].push_back(face.back_leaf);
    neighbours[face.back_leaf].push_back(face.front_leaf);
  }
  for (auto& list : neighbours) std::sort(list.begin(), list.end());
  return neighbours;
}

/// What lies in each plane.
struct ByPlane {
  std::vector<std::uint32_t> interfaces;
  std::vector<const InPlane*> covers;
  Box bounds;  ///< of the covers
};

std::vector<ByPlane> sort_by_plane(std::span<const LeafInterface> interfaces, const BspTree& tree,
                                   std::size_t planes) {
  std::vector<ByPlane> sorted(planes);
  for (std::uint32_t i = 0; i < interfaces.size(); ++i) {
    if (!interfaces[i].openings.empty()) sorted[interfaces[i].plane].interfaces.push_back(i);
  }
  for (const BspCut& cut : tree.cuts) {
    for (const InPlane& cover : cut.covered_by) {
      sorted[cut.plane].covers.push_back(&cover);
      sorted[cut.plane].bounds.add(cover.box);
    }
  }
  return sorted;
}

/// Whether a plane runs through a box by more than the tolerance on both sides.
bool reaches(const Box& box, const Plane& plane, double tolerance_m) {
  const double half = 0.5 * glm::dot(glm::abs(plane.n), box.extent());
  return std::abs(plane.signed_distance(box.center())) < half - tolerance_m;
}

/// Adds the sections of the leaves across the plane, as far as the polygons in the plane reach.
void add_sections(Apertures& apertures, const BoxTree& leaves, std::span<const Box> boxes,
                  const BspTree& tree, const Plane& plane, const Box& bounds, double tolerance_m) {
  for (const std::uint32_t leaf : leaves.touching(bounds, 0.0)) {
    if (!reaches(boxes[leaf], plane, tolerance_m)) continue;
    const DistanceRange range = distances(tree.leaves[leaf], plane);
    if (range.highest <= tolerance_m || range.lowest >= -tolerance_m) continue;
    Polygon section = cross_section(tree.leaves[leaf], plane);
    if (section.size() >= 3 && area_m2(section) > tolerance_m * tolerance_m)
      apertures.add_section(std::move(section), leaf);
  }
}

}  // namespace

std::vector<LeafAcross> frame_apertures(std::span<LeafInterface> interfaces, const BspTree& tree,
                                        const PlaneSet& planes, const ApertureConfig& config) {
  const auto neighbours = open_neighbours(interfaces, tree.leaves.size());
  const std::vector<ByPlane> by_plane = sort_by_plane(interfaces, tree, planes.planes.size());
  std::vector<Box> boxes;
  for (const Region& leaf : tree.leaves) boxes.push_back(bounds(leaf));
  const BoxTree leaves(boxes);
  for (LeafInterface& face : interfaces) face.framed_m2 = 0.0;
  std::vector<LeafAcross> across;
  for (std::uint32_t number = 0; number < by_plane.size(); ++number) {
    const ByPlane& here = by_plane[number];
    if (here.covers.empty()) continue;
    const Plane& plane = planes.planes[number];
    Apertures apertures(neighbours, tree, plane.n, config.tolerance_m);
    for (const std::uint32_t i : here.interfaces) {
      for (const Polygon& p : interfaces[i].openings) apertures.add_opening(p, interfaces[i], i);
    }
    for (const InPlane* cover : here.covers) apertures.add_cover(*cover);
    if (std::abs(glm::dot(plane.n, config.up)) < config.upright)
      add_sections(apertures, leaves, boxes, tree, plane, here.bounds, config.tolerance_m);
    apertures.measure();
    for (std::uint32_t i = 0; i < apertures.openings().size(); ++i) {
      const Opening& opening = apertures.openings()[i];
      const double share = apertures.framed_share(i);
      if (opening.interface != Opening::none) {
        interfaces[opening.interface].framed_m2 += share * area_m2(opening.polygon);
      } else if (share >= config.door_share) {
        across.push_back({opening.front_leaf, number});
      }
    }
  }
  return across;
}

}  // namespace enfilade
