// Proofs that two sides are hidden from each other, plane by plane.
#include "visibility/occlusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "visibility/facing.hpp"
#include "visibility/line_sampling.hpp"

namespace enfilade {
namespace {

std::vector<Polygon> all_polygons(std::span<const Cluster> clusters) {
  std::vector<Polygon> polygons;
  for (const Cluster& cluster : clusters) {
    for (const ClusterPolygon& p : cluster.polygons) polygons.push_back(p.polygon);
  }
  return polygons;
}

/// Panes hide nothing.
std::vector<char> pane_flags(std::span<const Cluster> clusters) {
  std::vector<char> flags;
  for (const Cluster& cluster : clusters) {
    for (const ClusterPolygon& p : cluster.polygons) flags.push_back(p.pane ? 1 : 0);
  }
  return flags;
}

using Halves = std::array<std::vector<LineSpacePart>, 2>;

/// The parts behind the plane, then those in front of it. A part that lies in the plane is on the
/// side that it faces.
Halves cut_along(const LineSpaceSide& side, const Plane& plane, double flat_m) {
  Halves halves;
  for (const LineSpacePart& part : side.parts) {
    const auto [low, high, sum] = distances(part.polygon(), plane);
    const double facing = glm::dot(part.plane().n, plane.n);
    if (std::max(high, -low) <= flat_m && std::abs(facing) >= 0.5) {
      halves[facing > 0.0 ? 1 : 0].push_back(part);
    } else if (low >= 0.0 || high <= 0.0) {
      halves[low >= 0.0 ? 1 : 0].push_back(part);
    } else {
      auto [front, behind] = split(part.polygon(), plane, 0.0);
      if (front.size() >= 3) halves[1].push_back(part.cut_to(std::move(front)));
      if (behind.size() >= 3) halves[0].push_back(part.cut_to(std::move(behind)));
    }
  }
  return halves;
}

/// Several parts are divided by position along the longest axis; a single part is cut in the
/// middle.
Halves halves_of(const LineSpaceSide& side) {
  Plane plane;
  const int axis = side.box.longest_axis();
  plane.n = Vec3(0.0);
  plane.n[axis] = 1.0;
  plane.d = side.box.center()[axis];
  if (side.parts.size() > 1) {
    Halves halves;
    for (const LineSpacePart& part : side.parts) {
      halves[bounds(part.polygon()).center()[axis] > plane.d ? 1 : 0].push_back(part);
    }
    if (!halves[0].empty() && !halves[1].empty()) return halves;
  }
  return cut_along(side, plane, 0.0);
}

/// The polygon with every edge moved outwards by `margin_m`.
Polygon grown(const Polygon& polygon, const Vec3& n, double margin_m) {
  Polygon larger;
  const std::size_t size = polygon.size();
  const auto outward = [&](std::size_t i) {
    Vec3 side = glm::cross(polygon[(i + 1) % size] - polygon[i % size], n);
    const double length = glm::length(side);
    if (length <= 0.0) return Vec3(0.0);
    side /= length;
    return glm::dot(side, polygon[i % size] - centroid(polygon)) < 0.0 ? -side : side;
  };
  for (std::size_t i = 0; i < size; ++i) {
    const Vec3 a = outward(i + size - 1), b = outward(i);
    const double both = std::max(1.0 + glm::dot(a, b), 0.1);
    larger.push_back(polygon[i] + margin_m / both * (a + b));
  }
  return larger;
}

// Do the lines pass a window in this plane already that was hardly larger than what is open now?
bool is_known(const LineSpace& lines, const Plane& plane, const LineSpaceCrossing& at,
              double open_m2, double flat_m) {
  constexpr double much = 0.9;  // a window that shrinks by less is no progress
  for (std::size_t i = at.first; i < at.end; ++i) {
    const Polygon& window = lines.windows[i].polygon;
    if (lies_in(window, plane, flat_m) && open_m2 > much * area_m2(window)) return true;
  }
  return false;
}

}  // namespace

Occlusion::Occlusion(std::span<const Cluster> clusters, double tolerance_m,
                     const OcclusionConfig& config)
    : config_(config),
      tolerance_m_(tolerance_m),
      polygons_(all_polygons(clusters)),
      planes_(polygons_, pane_flags(clusters)),
      rays_(polygons_, pane_flags(clusters)) {
  std::uint32_t next = 0;
  Box box;
  for (const Cluster& cluster : clusters) {
    std::vector<LineSpacePart>& parts = clusters_.emplace_back();
    for (const ClusterPolygon& p : cluster.polygons) {
      parts.emplace_back(next, polygons_[next], plane_of(p.polygon));
      ++next;
    }
    box.add(cluster.bounds);
  }
  smallest_m_ = std::max(1e-3 * box.diagonal(), 16.0 * tolerance_m);
}

Sight Occlusion::between(std::uint32_t a, std::uint32_t b, int max_parts) const {
  Proof proof{Random(config_.seed + 0x9E3779B97F4A7C15ull * a + b), max_parts, config_.max_planes};
  LineSpace lines;
  lines.a = side_of(clusters_[a]);
  lines.b = side_of(clusters_[b]);
  return settle(std::move(lines), proof, config_.first_rays);
}

bool Occlusion::is_hidden(const WindowView& view) const {
  std::vector<LineSpacePart> parts;
  std::uint64_t key = view.path.size();
  for (const SourcePolygon* s : view.source) {
    parts.emplace_back(s->number, s->polygon, s->plane);
    key = key * 31 + s->number;
  }
  const Polygon window = grown(view.window, view.plane.n, tolerance_m_);
  const Plane back{-view.plane.n, -view.plane.d};
  LineSpace lines;
  lines.a = side_of(std::move(parts));
  lines.b = side_of({LineSpacePart(LineSpacePart::no_number, window, back)});
  // Leaving windows out only adds lines, so that a proof for the last few holds for all.
  for (const Window& w : view.path.last(std::min(config_.window_path, view.path.size()))) {
    lines.windows.push_back({grown(w.polygon, w.n, tolerance_m_), w.n});
  }
  Proof proof{Random(config_.seed + 0x9E3779B97F4A7C15ull * key), config_.window_parts,
              config_.window_planes};
  return settle(std::move(lines), proof, config_.window_rays) == Sight::hidden;
}

bool Occlusion::find_open_line(const LineSpace& lines, Proof& proof, int rays,
                               std::vector<Suspect>& suspects) const {
  for (int k = 0; k < rays; ++k) {
    std::optional<SampledLine> line = draw_line(lines, proof.random);
    const bool within = line.has_value();
    if (!within) line = draw_any_line(lines, proof.random);
    if (!line) continue;
    const bool back = k % 2 != 0;
    const Vec3& start = back ? line->b : line->a;
    const Vec3 d = (back ? line->a : line->b) - start;
    const std::uint32_t from = back ? line->to->number() : line->from->number();
    const std::uint32_t to = back ? line->from->number() : line->to->number();
    const RayHit hit = rays_.closest(start, d, from, glm::length(d) - rays_.epsilon_m());
    if (!hit.any() || hit.polygon == to) {
      if (within) return true;
      continue;
    }
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

Occlusion::Barrier Occlusion::best_barrier(const LineSpace& lines,
                                           std::span<const Suspect> suspects) const {
  // A flat polygon at an end hides nothing from itself: where it lies in the plane, it faces away
  // from the rest.
  std::vector<std::uint32_t> ends;
  for (const LineSpaceSide* side : {&lines.a, &lines.b}) {
    for (const LineSpacePart& part : side->parts) {
      if (part.number() != LineSpacePart::no_number && !planes_.is_flat(part.number()))
        ends.push_back(part.number());
    }
  }
  std::sort(ends.begin(), ends.end());
  Barrier best;
  for (const Suspect& suspect : suspects) {
    const auto found = crossing(lines, planes_.plane(suspect.plane), tolerance_m_);
    if (!found || found->region.size() < 3) continue;
    const double whole = area_m2(found->region);
    std::vector<Polygon> open =
        planes_.uncovered(suspect.plane, {found->region}, ends, config_.max_pieces);
    if (open.size() > config_.max_pieces) continue;
    double share = 0.0;
    for (const Polygon& p : open) share += area_m2(p) / whole;
    if (is_known(lines, planes_.plane(suspect.plane), *found, share * whole, tolerance_m_))
      continue;
    if (share < best.open_share)
      best = {suspect.plane, found->first, found->end, share, std::move(open)};
    if (best.open_share < 1.0 && best.windows.empty()) break;
  }
  return best;
}

LineSpace Occlusion::through(const LineSpace& lines, const Barrier& barrier,
                             const Polygon& window) const {
  const Plane& plane = planes_.plane(barrier.plane);
  // The window (or side) before the barrier says from which side of the plane the lines come.
  const std::vector<Vec3>& last =
      barrier.first == 0 ? lines.a.points : lines.windows[barrier.first - 1].polygon;
  double farthest = 0.0;
  for (const Vec3& p : last) {
    const double d = plane.signed_distance(p);
    if (std::abs(d) > std::abs(farthest)) farthest = d;
  }
  LineSpace narrow = lines;
  const auto at = narrow.windows.begin();
  const auto next = narrow.windows.erase(at + static_cast<std::ptrdiff_t>(barrier.first),
                                         at + static_cast<std::ptrdiff_t>(barrier.end));
  narrow.windows.insert(next, {window, farthest > 0.0 ? -plane.n : plane.n});
  return narrow;
}

Sight Occlusion::settle(LineSpace lines, Proof& proof, int rays) const {
  const double flat_m = rounding_m(tolerance_m_);
  if (!drop_averted(lines, flat_m) || !tighten(lines, flat_m)) return Sight::hidden;
  std::vector<Suspect> suspects;
  if (find_open_line(lines, proof, rays, suspects)) return Sight::open;
  const std::size_t tried = std::min(suspects.size(), static_cast<std::size_t>(proof.max_planes));
  const Barrier barrier = best_barrier(lines, std::span(suspects).first(tried));
  if (barrier.windows.empty() && barrier.open_share < 1.0) return Sight::hidden;
  if (--proof.parts_left <= 0 || proof.depth >= config_.max_depth) return Sight::unknown;
  ++proof.depth;
  Sight sight = Sight::hidden;
  if (barrier.open_share > config_.most_open) {
    sight = subdivide(lines, suspects, proof);
  } else {
    for (const Polygon& window : barrier.windows) {
      sight = settle(through(lines, barrier, window), proof, config_.rays);
      if (sight != Sight::hidden) break;
    }
  }
  --proof.depth;
  return sight;
}

// A side that lies on both sides of the plane that stops most rays is cut along it: the part beyond
// it may be hidden at once. Otherwise the longer side is cut in the middle.
Sight Occlusion::subdivide(const LineSpace& lines, std::span<const Suspect> suspects,
                           Proof& proof) const {
  for (const Suspect& suspect : suspects) {
    for (const bool cut_a : {true, false}) {
      Halves halves =
          cut_along(cut_a ? lines.a : lines.b, planes_.plane(suspect.plane), 2.0 * tolerance_m_);
      if (!halves[0].empty() && !halves[1].empty()) return settle(lines, cut_a, halves, proof);
    }
  }
  const bool cut_a = lines.a.box.diagonal() >= lines.b.box.diagonal();
  const LineSpaceSide& side = cut_a ? lines.a : lines.b;
  if (side.box.diagonal() <= smallest_m_) return Sight::unknown;
  Halves halves = halves_of(side);
  return settle(lines, cut_a, halves, proof);
}

Sight Occlusion::settle(const LineSpace& lines, bool cut_a, Halves& halves, Proof& proof) const {
  for (std::vector<LineSpacePart>& half : halves) {
    if (half.empty()) continue;
    LineSpace part = lines;
    (cut_a ? part.a : part.b) = side_of(std::move(half));
    const Sight sight = settle(std::move(part), proof, config_.rays);
    if (sight != Sight::hidden) return sight;  // the whole is not hidden then
  }
  return Sight::hidden;
}

}  // namespace enfilade
