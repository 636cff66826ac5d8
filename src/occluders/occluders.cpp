#include "occluders/occluders.hpp"

#include "geometry/clip.hpp"
#include "geometry/shaft_tree.hpp"

namespace enfilade {
namespace {

std::vector<Polygon> all_polygons(std::span<const Cluster> clusters) {
  std::vector<Polygon> polygons;
  for (const Cluster& c : clusters) {
    for (const ClusterPolygon& p : c.polygons) polygons.push_back(p.polygon);
  }
  return polygons;
}

std::vector<char> pane_flags(std::span<const Cluster> clusters) {
  std::vector<char> flags;
  for (const Cluster& c : clusters) {
    for (const ClusterPolygon& p : c.polygons) flags.push_back(p.pane ? 1 : 0);
  }
  return flags;
}

}  // namespace

Occluders::Occluders(std::span<const Cluster> clusters)
    : panes_(clusters),
      rays_(all_polygons(clusters), pane_flags(clusters)),
      shafts_(std::make_unique<ShaftTree>(all_polygons(clusters))) {
  Box box;
  std::uint32_t next = 0;
  for (const Cluster& c : clusters) {
    if (c.id.index() >= first_.size()) first_.resize(c.id.index() + 1, 0);
    first_[c.id.index()] = next;
    next += static_cast<std::uint32_t>(c.polygons.size());
    for (std::uint32_t k = 0; k < c.polygons.size(); ++k) {
      refs_.push_back({c.id, k});
      for (const Vec3& v : c.polygons[k].polygon) box.add(v);
    }
  }
  extent_m_ = box.diagonal();
}

Occluders::~Occluders() = default;
Occluders::Occluders(Occluders&&) noexcept = default;
Occluders& Occluders::operator=(Occluders&&) noexcept = default;

bool Occluders::shaft_open(const Polygon& a, const Polygon& b, std::uint32_t skip_a,
                           std::uint32_t skip_b) const {
  return !shafts_->blocked(shaft_between(a, b, tolerance_m()), tolerance_m(), skip_a, skip_b);
}

bool Occluders::find_between(const Polygon& a, const Polygon& b, std::uint32_t skip_a,
                             std::uint32_t skip_b, std::size_t most,
                             std::vector<std::uint32_t>& found) const {
  found.clear();
  shafts_->find(shaft_between(a, b, tolerance_m()), tolerance_m(), skip_a, skip_b, most, found);
  const bool complete = found.size() <= most;
  if (panes_.any())
    std::erase_if(found, [this](std::uint32_t polygon) { return panes_.contains(polygon); });
  return complete;
}

void Occluders::find_among(std::span<const std::uint32_t> among, const Polygon& a, const Polygon& b,
                           std::uint32_t skip_a, std::uint32_t skip_b,
                           std::vector<std::uint32_t>& found) const {
  found.clear();
  shafts_->find_among(among, shaft_between(a, b, tolerance_m()), tolerance_m(), skip_a, skip_b,
                      found);
}

Passage Occluders::passage(const Vec3& a, const Vec3& b, std::uint32_t skip_a, std::uint32_t skip_b,
                           RayStart start) const {
  if (rays_.occluded(a, b, skip_a, skip_b, start)) return {0.0, {}};
  if (!panes_.any()) return {};
  const Vec3 d = b - a;
  const double length_m = glm::length(d) - rays_.epsilon_m();
  Passage passed;
  if (length_m <= rays_.epsilon_m()) return passed;
  std::vector<PaneCrossing> found;
  rays_.crossings(a, d, length_m, skip_a, skip_b, start, found);
  for (const PaneCrossing& c : found) panes_.dim(passed, c.polygon, c.cosine);
  return passed;
}

Passage Occluders::dimmed(const Vec3& from, const Vec3& direction, double distance_m,
                          std::uint32_t skip, RayStart start) const {
  Passage passed;
  if (!panes_.any()) return passed;
  std::vector<PaneCrossing> found;
  rays_.crossings(from, direction, distance_m, skip, skip, start, found);
  for (const PaneCrossing& c : found) panes_.dim(passed, c.polygon, c.cosine);
  return passed;
}

std::vector<PaneMet> Occluders::panes_along(const Vec3& from, const Vec3& direction,
                                            double distance_m, std::uint32_t skip,
                                            RayStart start) const {
  std::vector<PaneCrossing> found;
  rays_.crossings(from, direction, distance_m, skip, skip, start, found);
  std::vector<PaneMet> met;
  Passage passed;
  for (const PaneCrossing& c : found) {
    PaneMet pane{c.polygon, c.cosine > 0.0, c.distance_m, passed, {}};
    panes_.dim(passed, c.polygon, c.cosine);
    pane.behind = passed;
    met.push_back(std::move(pane));
  }
  // Of a two-sided pane and its back, in one place, the one that shows its front comes first.
  for (std::size_t i = 1; i < met.size(); ++i) {
    const bool one_place = met[i].distance_m - met[i - 1].distance_m <= 2.0 * rays_.epsilon_m();
    if (one_place && met[i].front && !met[i - 1].front) met[i].before = met[i - 1].before;
  }
  return met;
}

void Occluders::panes_between(const Polygon& a, const Polygon& b, std::uint32_t skip_a,
                              std::uint32_t skip_b, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (panes_.any()) panes_.find_between(a, b, tolerance_m(), skip_a, skip_b, found);
}

const Polygon& Occluders::polygon(std::uint32_t global) const { return shafts_->polygon(global); }

bool Occluders::shaft_shut(const Polygon& a, const Polygon& b, std::uint32_t blocker) const {
  // All segments cross the blocker's plane within the convex hull of the corner-to-corner
  // crossings, so it is enough that each of these lies inside the (convex) blocker.
  const Polygon& wall = shafts_->polygon(blocker);
  const Plane plane = plane_of(wall);
  for (const Vec3& p : a) {
    const double side_p = plane.signed_distance(p);
    for (const Vec3& q : b) {
      const double side_q = plane.signed_distance(q);
      if (side_p * side_q >= 0.0) return false;
      if (!contains(wall, plane.n, zero_crossing(p, side_p, q, side_q))) return false;
    }
  }
  return true;
}

std::vector<std::uint32_t> Occluders::touching(const Vec3& p, double reach_m) const {
  return shafts_->touching(p, reach_m);
}

std::size_t Occluders::bytes() const {
  return rays_.bytes() + refs_.size() * (sizeof(PolygonRef) + 4 * sizeof(Vec3) + 80);
}

}  // namespace enfilade
