#include "visibility/occlusion.hpp"

#include <algorithm>
#include <cmath>

#include "visibility/facing.hpp"
#include "visibility/half_spaces.hpp"

namespace enfilade {
namespace {

constexpr std::size_t most_points = 12;

std::vector<Polygon> all_polygons(std::span<const Cluster> clusters) {
  std::vector<Polygon> polygons;
  for (const Cluster& cluster : clusters) {
    for (const ClusterPolygon& p : cluster.polygons) polygons.push_back(p.polygon);
  }
  return polygons;
}

void add_distinct(std::vector<Vec3>& points, const Polygon& polygon) {
  for (const Vec3& p : polygon) {
    if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
  }
}

std::vector<Vec3> corners(const Box& box) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) {
    points.emplace_back(i & 1 ? box.hi.x : box.lo.x, i & 2 ? box.hi.y : box.lo.y,
                        i & 4 ? box.hi.z : box.lo.z);
  }
  return points;
}

Vec3 random_point(const Polygon& p, Random& random) {
  const std::size_t k = p.size() <= 3 ? 1 : 1 + random.below(p.size() - 2);
  const double s = std::sqrt(random.uniform()), t = random.uniform();
  return (1.0 - s) * p[0] + s * ((1.0 - t) * p[k] + t * p[k + 1]);
}

// The part of the points' hull in front of the plane (d >= 0), as points; `sign` -1 for behind.
std::vector<Vec3> clip_points(const std::vector<Vec3>& points, const Plane& plane, double sign) {
  std::vector<Vec3> kept;
  for (const Vec3& p : points) {
    const double dp = sign * plane.signed_distance(p);
    if (dp >= 0.0) kept.push_back(p);
    if (dp <= 0.0) continue;
    for (const Vec3& q : points) {
      const double dq = sign * plane.signed_distance(q);
      if (dq < 0.0) kept.push_back(p + dp / (dp - dq) * (q - p));
    }
  }
  return kept;
}

}  // namespace

Occlusion::Occlusion(std::span<const Cluster> clusters, double tolerance_m,
                     const OcclusionConfig& config)
    : config_(config),
      tolerance_m_(tolerance_m),
      polygons_(all_polygons(clusters)),
      planes_(polygons_),
      rays_(polygons_) {
  std::uint32_t next = 0;
  Box box;
  for (const Cluster& cluster : clusters) {
    std::vector<Part>& parts = clusters_.emplace_back();
    for (const ClusterPolygon& p : cluster.polygons) {
      parts.push_back({{p.polygon, plane_of(p.polygon)}, next++});
    }
    box.add(cluster.bounds);
  }
  smallest_m_ = std::max(1e-3 * box.diagonal(), 16.0 * tolerance_m);
}

Occlusion::Side Occlusion::side_of(std::vector<Part> parts) const {
  Side side;
  for (const Part& part : parts) {
    side.box.add(bounds(part.shape.polygon));
    if (side.points.size() <= most_points) add_distinct(side.points, part.shape.polygon);
  }
  if (side.points.size() > most_points) side.points = corners(side.box);
  side.parts = std::move(parts);
  return side;
}

// Leaves only what has some of the other side in front of it; false where nothing is left.
bool Occlusion::drop_averted(Side& a, Side& b) const {
  for (int pass = 0; pass < 2; ++pass) {
    for (auto [side, other] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
      const std::size_t before = side->parts.size();
      std::erase_if(side->parts, [&](const Part& part) {
        return !any_in_front(other->box, part.shape.plane) ||
               std::none_of(other->parts.begin(), other->parts.end(), [&](const Part& o) {
                 return any_in_front(o.shape.polygon, part.shape.plane);
               });
      });
      if (side->parts.empty()) return false;
      if (side->parts.size() < before) *side = side_of(std::move(side->parts));
    }
  }
  if (a.parts.size() > 1 || b.parts.size() > 1) return true;
  // One polygon against one: only what lies before the other takes part.
  for (auto [side, other] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    clip_front(side->parts[0].shape.polygon, other->parts[0].shape.plane, 0.0);
    if (side->parts[0].shape.polygon.size() < 3) return false;
    *side = side_of(std::move(side->parts));
  }
  return true;
}

Sight Occlusion::between(std::uint32_t a, std::uint32_t b) const {
  Proof proof{Random(config_.seed + 0x9E3779B97F4A7C15ull * a + b), config_.max_parts};
  return settle(side_of(clusters_[a]), side_of(clusters_[b]), proof, config_.first_rays);
}

bool Occlusion::find_open_line(const Side& a, const Side& b, Proof& proof, int rays,
                               std::vector<Suspect>& suspects) const {
  for (int k = 0; k < rays; ++k) {
    const Part& from = a.parts[proof.random.below(a.parts.size())];
    const Part& to = b.parts[proof.random.below(b.parts.size())];
    const Vec3 p = random_point(from.shape.polygon, proof.random);
    const Vec3 q = random_point(to.shape.polygon, proof.random);
    if (from.shape.plane.signed_distance(q) <= 0.0 || to.shape.plane.signed_distance(p) <= 0.0) {
      continue;
    }
    const bool back = k % 2 != 0;
    const Vec3 d = back ? p - q : q - p;
    const double length = glm::length(d);
    const RayHit hit = rays_.closest(back ? q : p, d, back ? to.polygon : from.polygon,
                                     length - rays_.epsilon_m());
    if (!hit.any() || hit.polygon == (back ? from.polygon : to.polygon)) return true;
    const std::uint32_t plane = planes_.plane_of_polygon(hit.polygon);
    const auto at = std::find_if(suspects.begin(), suspects.end(),
                                 [&](const Suspect& s) { return s.plane == plane; });
    if (at == suspects.end()) {
      suspects.push_back({plane, 1});
    } else {
      ++at->rays;
    }
  }
  std::stable_sort(suspects.begin(), suspects.end(),
                   [](const Suspect& s, const Suspect& t) { return s.rays > t.rays; });
  return false;
}

// All that lines between the sides can cross of the plane; empty where it does not part them.
Polygon Occlusion::crossing(const Side& a, const Side& b, std::uint32_t k) const {
  const Plane& plane = planes_.plane(k);
  double sign = 0.0;
  const auto fits = [&](const Side& side, double s) {
    return std::all_of(side.parts.begin(), side.parts.end(), [&](const Part& part) {
      const Polygon& polygon = part.shape.polygon;
      double highest = 0.0;
      for (const Vec3& p : polygon) {
        const double d = s * plane.signed_distance(p);
        if (d < -1e-3 * tolerance_m_) return false;
        highest = std::max(highest, d);
      }
      // A polygon in the plane itself: nothing there hides what it looks at.
      return highest > 2.0 * tolerance_m_ || s * glm::dot(part.shape.plane.n, plane.n) > 0.5;
    });
  };
  if (fits(a, 1.0) && fits(b, -1.0)) sign = 1.0;
  if (sign == 0.0 && fits(a, -1.0) && fits(b, 1.0)) sign = -1.0;
  if (sign == 0.0) return {};
  std::vector<Vec3> crossings;
  const std::vector<Vec3> on_a = clip_points(a.points, plane, sign);
  const std::vector<Vec3> on_b = clip_points(b.points, plane, -sign);
  for (const Vec3& p : on_a) {
    const double dp = std::abs(plane.signed_distance(p));
    for (const Vec3& q : on_b) {
      const double sum = dp + std::abs(plane.signed_distance(q));
      crossings.push_back(sum > 0.0 ? p + dp / sum * (q - p) : p);
      if (sum <= 0.0) crossings.push_back(q);
    }
  }
  Polygon region = convex_hull(std::move(crossings), plane.n);
  if (region.size() < 3 || area_m2(region) <= 1e-3 * tolerance_m_ * diameter(region)) return {};
  return region;
}

std::vector<Polygon> Occlusion::openings(const Side& a, const Side& b, std::uint32_t plane,
                                         std::vector<Polygon> region) const {
  std::vector<std::uint32_t> ends;
  for (const Side* side : {&a, &b}) {
    for (const Part& part : side->parts) ends.push_back(part.polygon);
  }
  std::sort(ends.begin(), ends.end());
  return planes_.uncovered(plane, std::move(region), ends, config_.max_pieces);
}

Occlusion::Barrier Occlusion::best_barrier(const Side& a, const Side& b,
                                           std::span<const Suspect> suspects) const {
  Barrier best;
  for (const Suspect& suspect : suspects) {
    const Polygon region = crossing(a, b, suspect.plane);
    if (region.empty()) continue;
    const double whole = area_m2(region);
    std::vector<Polygon> open = openings(a, b, suspect.plane, {region});
    if (open.size() > config_.max_pieces) continue;
    double share = 0.0;
    for (const Polygon& p : open) share += area_m2(p) / whole;
    if (share < best.open_share) best = {suspect.plane, share, std::move(open)};
    if (best.windows.empty()) break;
  }
  return best;
}

// What of both sides lines through the window can join; false where there is none.
bool Occlusion::narrow(Side& a, Side& b, std::uint32_t k, const Polygon& window) const {
  const Plane& plane = planes_.plane(k);
  double farthest = 0.0;
  for (const Vec3& p : a.points) {
    const double d = plane.signed_distance(p);
    if (std::abs(d) > std::abs(farthest)) farthest = d;
  }
  const double sign = farthest > 0.0 ? 1.0 : -1.0;  // a's side of the plane
  const double slack_m = 1e-3 * tolerance_m_;
  HalfSpaces to_b, to_a;
  add_penumbra(clip_points(a.points, plane, sign), window, -sign * plane.n, slack_m, to_b);
  add_penumbra(clip_points(b.points, plane, -sign), window, sign * plane.n, slack_m, to_a);
  for (auto [side, spaces] : {std::pair{&b, &to_b}, std::pair{&a, &to_a}}) {
    for (Part& part : side->parts) {
      part.shape.polygon = clip_to(std::move(part.shape.polygon), *spaces, slack_m);
    }
    std::erase_if(side->parts, [](const Part& part) { return part.shape.polygon.size() < 3; });
    if (side->parts.empty()) return false;
    *side = side_of(std::move(side->parts));
  }
  return true;
}

Sight Occlusion::settle(Side a, Side b, Proof& proof, int rays) const {
  if (!drop_averted(a, b)) return Sight::hidden;
  std::vector<Suspect> suspects;
  if (find_open_line(a, b, proof, rays, suspects)) return Sight::open;
  const std::size_t tried = std::min(suspects.size(), static_cast<std::size_t>(config_.max_planes));
  const Barrier barrier = best_barrier(a, b, std::span(suspects).first(tried));
  if (barrier.windows.empty() && barrier.open_share < 1.0) return Sight::hidden;
  if (--proof.parts_left <= 0) return Sight::unknown;
  if (barrier.open_share > config_.most_open) return take_apart(a, b, proof);
  Sight sight = Sight::hidden;
  for (const Polygon& window : barrier.windows) {
    Side near = a, far = b;
    if (!narrow(near, far, barrier.plane, window)) continue;
    const Sight one = settle(std::move(near), std::move(far), proof, config_.rays);
    if (one == Sight::open) return one;
    if (one == Sight::unknown) sight = one;
    if (proof.parts_left <= 0) return Sight::unknown;
  }
  return sight;
}

// The longer side in the middle.
Sight Occlusion::take_apart(const Side& a, const Side& b, Proof& proof) const {
  const bool cut_a = a.box.diagonal() >= b.box.diagonal();
  const Side& side = cut_a ? a : b;
  const Side& other = cut_a ? b : a;
  if (side.box.diagonal() <= smallest_m_) return Sight::unknown;
  std::vector<Part> halves[2];
  const Vec3 e = side.box.extent();
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  const double middle = side.box.center()[axis];
  if (side.parts.size() > 1) {
    for (const Part& part : side.parts) {
      halves[bounds(part.shape.polygon).center()[axis] > middle ? 1 : 0].push_back(part);
    }
  }
  if (halves[0].empty() || halves[1].empty()) {
    halves[0].clear();
    halves[1].clear();
    Plane plane;
    plane.n = Vec3(0.0);
    plane.n[axis] = 1.0;
    plane.d = middle;
    for (const Part& part : side.parts) {
      auto [front, behind] = split(part.shape.polygon, plane, 0.0);
      if (front.size() >= 3)
        halves[1].push_back({{std::move(front), part.shape.plane}, part.polygon});
      if (behind.size() >= 3) {
        halves[0].push_back({{std::move(behind), part.shape.plane}, part.polygon});
      }
    }
  }
  Sight sight = Sight::hidden;
  for (std::vector<Part>& half : halves) {
    if (half.empty()) continue;
    const Sight one = settle(side_of(std::move(half)), other, proof, config_.rays);
    if (one == Sight::open) return one;
    if (one == Sight::unknown) sight = one;
    if (proof.parts_left <= 0) return Sight::unknown;
  }
  return sight;
}

}  // namespace enfilade
