#include "import/intake/pane_bodies.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

/// Sides are parallel where their normals are so close.
constexpr double same_direction = 1.0 - 1e-6;
/// A thin part is at most so thick, by the side of the square of its area.
constexpr double most_thickness = 0.1;
/// Area and place of the sides of one pane may differ by this share.
constexpr double most_difference = 0.05;
/// Of a side's length: what lies in one plane.
constexpr double flat = 1e-4;
/// A solid of more faces is no pane.
constexpr std::size_t most_faces = 4096;

/// Faces in one plane that look the same way.
struct Side {
  Vec3 n{0.0}, centre{0.0};
  double area_m2 = 0.0;
  std::vector<std::size_t> faces;
  double length_m() const { return std::sqrt(area_m2); }
};

std::vector<Side> sides_of(const std::vector<Surface>& surfaces, std::size_t first) {
  std::vector<Side> sides;
  for (std::size_t i = first; i < surfaces.size(); ++i) {
    const Polygon& face = surfaces[i].vertices;
    const Vec3 n = normal(face), centre = centroid(face);
    const double area = area_m2(face);
    const auto own = std::ranges::find_if(sides, [&](const Side& side) {
      return glm::dot(side.n, n) > same_direction && std::abs(glm::dot(n, centre - side.centre)) <
                                                         flat * (side.length_m() + std::sqrt(area));
    });
    Side& side = own == sides.end() ? sides.emplace_back(Side{n, centre, 0.0, {}}) : *own;
    side.centre = (side.area_m2 * side.centre + area * centre) / (side.area_m2 + area);
    side.area_m2 += area;
    side.faces.push_back(i);
  }
  return sides;
}

/// The thickness of the part whose sides these are; 0 where they are not those of a thin part.
double thickness_m(const Side& a, const Side& b) {
  if (glm::dot(a.n, b.n) > -same_direction) return 0.0;
  const Vec3 apart = a.centre - b.centre;
  const double thickness = glm::dot(a.n, apart);
  const double larger = std::max(a.area_m2, b.area_m2), side = std::sqrt(larger);
  const bool alike = std::abs(a.area_m2 - b.area_m2) <= most_difference * larger &&
                     glm::length(apart - thickness * a.n) <= most_difference * side + thickness;
  return alike && thickness > 0.0 && thickness <= most_thickness * side ? thickness : 0.0;
}

/// A thin part: light passes the side that is kept.
struct Pane {
  const Side *kept, *dropped;
  double thickness_m;

  Box box;  ///< of both sides

  /// True for a face between the planes of both sides, and within their box.
  bool has_at_edge(const Polygon& face) const {
    const double slack = flat * kept->length_m();
    return std::ranges::all_of(face, [&](const Vec3& p) {
      const double below = glm::dot(kept->n, kept->centre - p);
      return below >= -slack && below <= thickness_m + slack && box.contains(p, slack);
    });
  }
};

/// Each side with the nearest that fits it.
std::vector<Pane> panes_of(const std::vector<Side>& sides, const std::vector<Surface>& surfaces) {
  std::vector<Pane> panes;
  std::vector<char> taken(sides.size(), 0);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    std::size_t nearest = i;
    double least = 0.0;
    for (std::size_t k = 0; k < sides.size() && taken[i] == 0; ++k) {
      if (k == i || taken[k] != 0) continue;
      const double thickness = thickness_m(sides[i], sides[k]);
      if (thickness > 0.0 && (nearest == i || thickness < least)) nearest = k, least = thickness;
    }
    if (nearest == i) continue;
    taken[i] = taken[nearest] = 1;
    Pane& pane = panes.emplace_back(Pane{&sides[i], &sides[nearest], least, {}});
    for (const Side* side : {pane.kept, pane.dropped}) {
      for (const std::size_t face : side->faces) {
        for (const Vec3& p : surfaces[face].vertices) pane.box.add(p);
      }
    }
  }
  return panes;
}

}  // namespace

void merge_pane_bodies(std::vector<Surface>& surfaces, std::size_t first) {
  std::vector<Side> sides;
  if (surfaces.size() - first <= most_faces) sides = sides_of(surfaces, first);
  const std::vector<Pane> panes = panes_of(sides, surfaces);
  enum class Use : char { half, whole, none };
  std::vector<Use> use(surfaces.size(), Use::half);
  for (std::size_t i = first; i < surfaces.size(); ++i) {
    const Polygon& face = surfaces[i].vertices;
    if (std::ranges::any_of(panes, [&](const Pane& pane) { return pane.has_at_edge(face); }))
      use[i] = Use::none;
  }
  for (const Pane& pane : panes) {
    for (const std::size_t i : pane.kept->faces) use[i] = Use::whole;
    for (const std::size_t i : pane.dropped->faces) use[i] = Use::none;
  }
  std::size_t end = first;
  for (std::size_t i = first; i < surfaces.size(); ++i) {
    if (use[i] == Use::none) continue;
    if (use[i] == Use::half) {
      for (double& band : surfaces[i].transmittance) band = std::sqrt(band);
    }
    if (end != i) surfaces[end] = std::move(surfaces[i]);
    ++end;
  }
  surfaces.erase(surfaces.begin() + static_cast<std::ptrdiff_t>(end), surfaces.end());
}

}  // namespace enfilade
