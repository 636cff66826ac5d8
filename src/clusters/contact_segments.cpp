// Segments in which other polygons meet a polygon's plane, clipped to the polygon.
#include "clusters/contact_segments.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/box_tree.hpp"
#include "geometry/clip.hpp"

namespace enfilade {
namespace {

/// The part of the segment in front of all planes; none where it only runs along one of them.
std::optional<Segment> clip(Segment s, const std::vector<Plane>& planes, double tolerance_m,
                            double min_length_m) {
  for (const Plane& plane : planes) {
    if (!clip_front(s, plane.flipped(), tolerance_m)) return std::nullopt;
  }
  if (s.length_m() < min_length_m) return std::nullopt;
  return s;
}

/// True where a plane through an edge of a polygon has the other polygon in front of it: then no
/// segment of the other is inside.
bool parted(const Polygon& other, const std::vector<Plane>& planes, double tolerance_m) {
  return std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
    return std::all_of(other.begin(), other.end(),
                       [&](const Vec3& p) { return plane.signed_distance(p) >= -tolerance_m; });
  });
}

bool same(const Segment& s, const Segment& t, double tolerance_m) {
  const auto close = [&](const Vec3& p, const Vec3& q) {
    return glm::length(p - q) <= tolerance_m;
  };
  return (close(s.a, t.a) && close(s.b, t.b)) || (close(s.a, t.b) && close(s.b, t.a));
}

std::vector<Box> boxes_of(std::span<const Polygon* const> polygons) {
  std::vector<Box> boxes;
  for (const Polygon* polygon : polygons) boxes.push_back(bounds(*polygon));
  return boxes;
}

}  // namespace

struct ContactSegments::Impl {
  Impl(std::span<const Polygon* const> all, double tolerance, double min_length)
      : polygons(all),
        tolerance_m(tolerance),
        min_length_m(min_length),
        boxes(boxes_of(all)),
        tree(boxes) {}

  std::span<const Polygon* const> polygons;
  double tolerance_m, min_length_m;
  std::vector<Box> boxes;
  BoxTree tree;

  void add(const Polygon& other, const Plane& plane, std::vector<Segment>& found) const;
};

/// The other polygon's edges in the plane, or else the line in which it crosses it.
void ContactSegments::Impl::add(const Polygon& other, const Plane& plane,
                                std::vector<Segment>& found) const {
  std::vector<double> distance;
  bool above = false, below = false;
  for (const Vec3& p : other) {
    const double d = plane.signed_distance(p);
    distance.push_back(std::abs(d) <= tolerance_m ? 0.0 : d);
    above |= distance.back() > 0.0;
    below |= distance.back() < 0.0;
  }
  std::vector<Vec3> crossing;
  for (std::size_t i = 0; i < other.size(); ++i) {
    const std::size_t j = (i + 1) % other.size();
    if (distance[i] == 0.0) crossing.push_back(other[i]);
    if (distance[i] == 0.0 && distance[j] == 0.0 && !(above && below)) {
      found.push_back({other[i], other[j]});
    }
    if (distance[i] * distance[j] < 0.0) {
      crossing.push_back(zero_crossing(other[i], distance[i], other[j], distance[j]));
    }
  }
  // A convex polygon crosses a plane in one segment.
  if (above && below && crossing.size() >= 2) found.push_back({crossing.front(), crossing.back()});
}

ContactSegments::ContactSegments(std::span<const Polygon* const> polygons, double tolerance_m,
                                 double min_length_m)
    : impl_(std::make_unique<Impl>(polygons, tolerance_m, min_length_m)) {}

ContactSegments::~ContactSegments() = default;

std::vector<Segment> ContactSegments::inside(std::size_t i) const {
  const Polygon& polygon = *impl_->polygons[i];
  const Plane plane = plane_of(polygon);
  const std::vector<Plane> planes = edge_planes(polygon, plane.n, 0.0);
  std::vector<Segment> all;
  for (const std::uint32_t j : impl_->tree.touching(impl_->boxes[i], impl_->tolerance_m)) {
    const Polygon& other = *impl_->polygons[j];
    if (j != i && !parted(other, planes, impl_->tolerance_m)) impl_->add(other, plane, all);
  }

  std::vector<Segment> clipped;
  for (const Segment& s : all) {
    const auto part = clip(s, planes, impl_->tolerance_m, impl_->min_length_m);
    if (part) clipped.push_back(*part);
  }
  std::stable_sort(clipped.begin(), clipped.end(),
                   [](const Segment& s, const Segment& t) { return s.length_m() > t.length_m(); });
  std::vector<Segment> distinct;
  for (const Segment& s : clipped) {
    bool known = false;  // only segments of the same length can be the same
    for (std::size_t k = distinct.size(); k-- > 0 && !known;) {
      if (distinct[k].length_m() > s.length_m() + 2.0 * impl_->tolerance_m) break;
      known = same(distinct[k], s, impl_->tolerance_m);
    }
    if (!known) distinct.push_back(s);
  }
  return distinct;
}

void find_contacts(std::span<Cluster> clusters, double tolerance_m, const ContactConfig& config) {
  Box box;
  std::vector<const Polygon*> polygons;
  for (const Cluster& cluster : clusters) {
    box.add(cluster.bounds);
    for (const ClusterPolygon& p : cluster.polygons) polygons.push_back(&p.polygon);
  }
  const ContactSegments contacts(polygons, tolerance_m,
                                 config.min_length_relative * box.diagonal());
  std::size_t next = 0;
  for (Cluster& cluster : clusters) {
    for (ClusterPolygon& p : cluster.polygons) {
      p.contacts = contacts.inside(next++);
      if (p.contacts.size() > config.most) p.contacts.resize(config.most);
    }
  }
}

}  // namespace enfilade
