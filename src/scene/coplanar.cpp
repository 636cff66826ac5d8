#include "scene/coplanar.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "geometry/box_tree.hpp"
#include "geometry/clip.hpp"
#include "scene/convex_parts.hpp"

namespace enfilade {
namespace {

/// What the pieces of one surface look like, to compare with others.
using Material = std::tuple<Spectrum, Spectrum, Spectrum>;

class Covers {
 public:
  Covers(const std::vector<Piece>& pieces, const Scene& scene, const SceneScale& scale)
      : pieces_(pieces), scene_(scene), scale_(scale) {
    for (const Piece& piece : pieces) {
      planes_.push_back(plane_of(piece.polygon));
      boxes_.push_back(bounds(piece.polygon));
      areas_m2_.push_back(area_m2(piece.polygon));
    }
    covered_.area_m2.assign(pieces.size(), 0.0);
    covered_.duplicate.assign(pieces.size(), false);
  }

  /// Of pieces with the same outline and material, the first stays.
  void drop_duplicates() {
    std::map<Material, Pile> kept;
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      Pile& pile = kept[{surface(i).reflectance, surface(i).exitance, surface(i).transmittance}];
      const auto near = pile.touching(boxes_[i], scale_.coplanar());
      covered_.duplicate[i] =
          std::any_of(near.begin(), near.end(), [&](auto j) { return same_outline(i, j); });
      if (covered_.duplicate[i])
        covered_.area_m2[i] = areas_m2_[i];
      else
        pile.add(i, boxes_[i]);
    }
  }

  /// From the front to the back: each piece loses what lies under those in front of it. What is
  /// covered as a whole covers nothing itself that is not covered already, so that a pile of any
  /// height costs each piece its visible neighbours alone.
  std::vector<Piece> cut() {
    std::vector<std::vector<Polygon>> left(pieces_.size());
    Pile seen;
    for (const std::uint32_t i : from_the_front()) {
      bool overlapped = false;
      left[i] = {pieces_[i].polygon};
      for (const std::uint32_t j : seen.touching(boxes_[i], scale_.coplanar())) {
        if (left[i].empty()) break;
        if (!may_overlap(i, j) || !overlap(i, j)) continue;
        overlapped = true;
        take_away(left[i], pieces_[j].polygon);
      }
      std::erase_if(left[i], [&](const Polygon& p) {
        return width_of(p) <= scale_.sliver(bounds(p).diagonal());
      });
      if (overlapped) {
        covered_.area_m2[i] = areas_m2_[i];
        for (const Polygon& part : left[i]) covered_.area_m2[i] -= area_m2(part);
      }
      if (!left[i].empty()) seen.add(i, boxes_[i]);
    }
    std::vector<Piece> remaining;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (Polygon& part : left[i])
        remaining.push_back({pieces_[i].surface, std::move(part), pieces_[i].reversed});
    }
    return remaining;
  }

  Covered take() { return std::move(covered_); }

 private:
  /// Pieces that are looked up by their boxes.
  struct Pile {
    BoxTree tree;
    std::vector<std::uint32_t> pieces;

    void add(std::uint32_t piece, const Box& box) {
      tree.add(box);
      pieces.push_back(piece);
    }
    /// In ascending order.
    std::vector<std::uint32_t> touching(const Box& box, double margin_m) const {
      std::vector<std::uint32_t> found = tree.touching(box, margin_m);
      for (std::uint32_t& f : found) f = pieces[f];
      std::sort(found.begin(), found.end());
      return found;
    }
  };

  /// What emits first, then what comes later in the file; without duplicates.
  std::vector<std::uint32_t> from_the_front() const {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      if (!covered_.duplicate[i]) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const bool a_emits = surface(a).emits(), b_emits = surface(b).emits();
      return a_emits != b_emits ? a_emits : pieces_[a].surface > pieces_[b].surface;
    });
    return order;
  }

  // Cheap: same facing, and not wholly on one side of the other's plane.
  bool may_overlap(std::uint32_t i, std::uint32_t j) const {
    if (pieces_[i].surface == pieces_[j].surface || glm::dot(planes_[i].n, planes_[j].n) < 0.999)
      return false;
    const double tolerance = scale_.coplanar();
    bool above = false, below = false;
    for (const Vec3& p : pieces_[j].polygon) {
      const double d = planes_[i].signed_distance(p);
      above |= d >= -tolerance;
      below |= d <= tolerance;
    }
    return above && below;
  }

  /// Returns what two pieces have in common in their plane; null where that is nothing.
  std::optional<Polygon> overlap(std::uint32_t i, std::uint32_t j) const {
    Polygon common = intersect_coplanar(pieces_[i].polygon, pieces_[j].polygon, scale_.cut());
    if (common.size() < 3 || width_of(common) <= scale_.cut()) return std::nullopt;
    const double tolerance = scale_.coplanar();
    for (const Vec3& p : common) {
      // Parallel within a degree is not enough: where they overlap they must be in one plane.
      if (std::abs(planes_[i].signed_distance(p)) > tolerance ||
          std::abs(planes_[j].signed_distance(p)) > tolerance)
        return std::nullopt;
    }
    return common;
  }

  bool same_outline(std::uint32_t i, std::uint32_t j) const {
    // Cheap first: of the same outline they have the same area.
    const double longest = scale_.cut() * 4.0 * boxes_[i].diagonal();
    if (std::abs(areas_m2_[i] - areas_m2_[j]) > longest || !may_overlap(i, j)) return false;
    const std::optional<Polygon> common = overlap(i, j);
    if (!common) return false;
    const double shared = area_m2(*common), slack = scale_.cut() * 4.0 * bounds(*common).diagonal();
    return areas_m2_[i] - shared <= slack && areas_m2_[j] - shared <= slack;
  }

  void take_away(std::vector<Polygon>& parts, const Polygon& cover) const {
    std::vector<Polygon> next;
    const Box box = bounds(cover);
    // Beside the cover by more than both tolerances; part and cover may also
    // lie this far apart across their plane.
    const double margin = 2.0 * (scale_.coplanar() + scale_.cut());
    for (Polygon& part : parts) {
      if (!bounds(part).overlaps(box, margin)) {
        next.push_back(std::move(part));
        continue;
      }
      for (Polygon& left : subtract_coplanar(part, cover, scale_.cut()))
        next.push_back(std::move(left));
    }
    parts = std::move(next);
  }

  const Surface& surface(std::uint32_t i) const {
    return scene_.surfaces[pieces_[i].surface.index()];
  }

  const std::vector<Piece>& pieces_;
  const Scene& scene_;
  const SceneScale& scale_;
  std::vector<Plane> planes_;
  std::vector<Box> boxes_;
  std::vector<double> areas_m2_;
  Covered covered_;
};

}  // namespace

Covered cut_covered(std::vector<Piece>& pieces, const Scene& scene, const SceneScale& scale) {
  Covers covers(pieces, scene, scale);
  covers.drop_duplicates();
  std::vector<Piece> remaining = covers.cut();
  pieces = std::move(remaining);
  return covers.take();
}

}  // namespace enfilade
