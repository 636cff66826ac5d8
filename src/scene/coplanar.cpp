#include "scene/coplanar.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/box_tree.hpp"
#include "geometry/clip.hpp"
#include "scene/convex_parts.hpp"

namespace enfilade {
namespace {

bool emits(const Surface& surface) {
  return std::any_of(surface.exitance.begin(), surface.exitance.end(),
                     [](double e) { return e > 0.0; });
}

class Overlaps {
 public:
  Overlaps(const std::vector<Piece>& pieces, const Scene& scene, const SceneScale& scale)
      : pieces_(pieces),
        scene_(scene),
        tolerance_(scale.coplanar()),
        cut_(scale.cut()),
        in_front_(pieces.size()),
        duplicate_(pieces.size(), false) {
    for (const Piece& piece : pieces) {
      planes_.push_back(plane_of(piece.polygon));
      boxes_.push_back(bounds(piece.polygon));
    }
  }

  void find() {
    const BoxTree tree(boxes_);
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      for (const std::uint32_t j : tree.touching(boxes_[i], tolerance_)) {
        if (j > i && may_overlap(i, j)) note_overlap(i, j);
      }
    }
  }

  const std::vector<std::uint32_t>& in_front_of(std::size_t i) const { return in_front_[i]; }
  bool duplicate(std::size_t i) const { return duplicate_[i]; }
  std::vector<bool> take_duplicates() { return std::move(duplicate_); }

 private:
  // Cheap: same facing, and not wholly on one side of the other's plane.
  bool may_overlap(std::uint32_t i, std::uint32_t j) const {
    if (pieces_[i].surface == pieces_[j].surface || glm::dot(planes_[i].n, planes_[j].n) < 0.999)
      return false;
    bool above = false, below = false;
    for (const Vec3& p : pieces_[j].polygon) {
      const double d = planes_[i].signed_distance(p);
      above |= d >= -tolerance_;
      below |= d <= tolerance_;
    }
    return above && below;
  }

  void note_overlap(std::uint32_t i, std::uint32_t j) {
    const Polygon common = intersect_coplanar(pieces_[i].polygon, pieces_[j].polygon, cut_);
    if (common.size() < 3 || width_of(common) <= cut_) return;
    for (const Vec3& p : common) {
      // Parallel within a degree is not enough: where they overlap they must be in one plane.
      if (std::abs(planes_[i].signed_distance(p)) > tolerance_ ||
          std::abs(planes_[j].signed_distance(p)) > tolerance_)
        return;
    }
    const Surface& a = surface(i);
    const Surface& b = surface(j);
    const double shared = area_m2(common), slack = cut_ * 4.0 * bounds(common).diagonal();
    const bool same_outline = area_m2(pieces_[i].polygon) - shared <= slack &&
                              area_m2(pieces_[j].polygon) - shared <= slack;
    if (same_outline && a.reflectance == b.reflectance && a.exitance == b.exitance) {
      duplicate_[later_of(i, j)] = true;
      return;
    }
    const bool j_in_front = emits(a) != emits(b) ? emits(b) : later_of(i, j) == j;
    in_front_[j_in_front ? i : j].push_back(j_in_front ? j : i);
  }

  std::uint32_t later_of(std::uint32_t i, std::uint32_t j) const {
    return pieces_[i].surface > pieces_[j].surface ? i : j;
  }
  const Surface& surface(std::uint32_t i) const {
    return scene_.surfaces[pieces_[i].surface.index()];
  }

  const std::vector<Piece>& pieces_;
  const Scene& scene_;
  double tolerance_, cut_;
  std::vector<Plane> planes_;
  std::vector<Box> boxes_;
  std::vector<std::vector<std::uint32_t>> in_front_;
  std::vector<bool> duplicate_;
};

}  // namespace

Covered cut_covered(std::vector<Piece>& pieces, const Scene& scene, const SceneScale& scale) {
  Overlaps overlaps(pieces, scene, scale);
  overlaps.find();
  Covered covered{std::vector<double>(pieces.size(), 0.0), {}};
  std::vector<Piece> remaining;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double area = area_m2(pieces[i].polygon);
    covered.area_m2[i] = area;
    if (overlaps.duplicate(i)) continue;
    std::vector<Polygon> parts{pieces[i].polygon};
    for (const std::uint32_t j : overlaps.in_front_of(i)) {
      if (overlaps.duplicate(j)) continue;  // its twin covers the same
      std::vector<Polygon> next;
      for (const Polygon& part : parts) {
        for (Polygon& left : subtract_coplanar(part, pieces[j].polygon, scale.cut()))
          next.push_back(std::move(left));
      }
      parts = std::move(next);
    }
    std::erase_if(
        parts, [&](const Polygon& p) { return width_of(p) <= scale.sliver(bounds(p).diagonal()); });
    for (const Polygon& part : parts) covered.area_m2[i] -= area_m2(part);
    if (overlaps.in_front_of(i).empty()) covered.area_m2[i] = 0.0;
    for (Polygon& part : parts) remaining.push_back({pieces[i].surface, std::move(part)});
  }
  pieces = std::move(remaining);
  covered.duplicate = overlaps.take_duplicates();
  return covered;
}

}  // namespace enfilade
