#include "visibility/occlusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace enfilade {
namespace {

std::vector<Polygon> all_polygons(std::span<const Cluster> clusters) {
  std::vector<Polygon> polygons;
  for (const Cluster& cluster : clusters) {
    for (const ClusterPolygon& p : cluster.polygons) polygons.push_back(p.polygon);
  }
  return polygons;
}

/// By position where there are several, else cut in the middle.
std::array<std::vector<BeamPart>, 2> halves_of(const BeamSide& side) {
  std::array<std::vector<BeamPart>, 2> halves;
  const Vec3 e = side.box.extent();
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  const double middle = side.box.center()[axis];
  if (side.parts.size() > 1) {
    for (const BeamPart& part : side.parts) {
      halves[bounds(part.polygon()).center()[axis] > middle ? 1 : 0].push_back(part);
    }
    if (!halves[0].empty() && !halves[1].empty()) return halves;
    halves = {};
  }
  Plane plane;
  plane.n = Vec3(0.0);
  plane.n[axis] = 1.0;
  plane.d = middle;
  for (const BeamPart& part : side.parts) {
    auto [front, behind] = split(part.polygon(), plane, 0.0);
    if (front.size() >= 3) halves[1].push_back(part.cut_to(std::move(front)));
    if (behind.size() >= 3) halves[0].push_back(part.cut_to(std::move(behind)));
  }
  return halves;
}

/// Larger by `margin_m` on all sides.
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
    std::vector<BeamPart>& parts = clusters_.emplace_back();
    for (const ClusterPolygon& p : cluster.polygons) {
      parts.emplace_back(next, polygons_[next], plane_of(p.polygon));
      ++next;
    }
    box.add(cluster.bounds);
  }
  smallest_m_ = std::max(1e-3 * box.diagonal(), 16.0 * tolerance_m);
}

Sight Occlusion::between(std::uint32_t a, std::uint32_t b) const {
  return between({&a, 1}, {&b, 1}, config_.first_rays, config_.max_parts);
}

Sight Occlusion::between_groups(std::span<const std::uint32_t> a,
                                std::span<const std::uint32_t> b) const {
  return between(a, b, config_.group_rays, config_.group_parts);
}

Sight Occlusion::between(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b,
                         int rays, int max_parts) const {
  const std::uint64_t pair = (std::uint64_t{a[0]} << 32) + b[0];
  Proof proof{Random(config_.seed + 0x9E3779B97F4A7C15ull * pair), max_parts};
  Beam beam;
  for (auto [side, group] : {std::pair{&beam.a, a}, std::pair{&beam.b, b}}) {
    std::vector<BeamPart> parts;
    for (const std::uint32_t cluster : group) {
      parts.insert(parts.end(), clusters_[cluster].begin(), clusters_[cluster].end());
    }
    *side = side_of(std::move(parts));
  }
  return settle(std::move(beam), proof, rays);
}

bool Occlusion::is_hidden(const WindowView& view) const {
  std::vector<BeamPart> parts;
  std::uint64_t key = view.path.size();
  for (const SourcePolygon* s : view.source) {
    parts.emplace_back(s->number, s->polygon, s->plane);
    key = key * 31 + s->number;
  }
  const Polygon window = grown(view.window, view.plane.n, tolerance_m_);
  const Plane back{-view.plane.n, -view.plane.d};
  Beam beam;
  beam.a = side_of(std::move(parts));
  beam.b = side_of({BeamPart(BeamPart::no_number, window, back)});
  for (const Window& w : view.path) {
    beam.windows.push_back({grown(w.polygon, w.n, tolerance_m_), w.n});
  }
  Proof proof{Random(config_.seed + 0x9E3779B97F4A7C15ull * key), config_.window_parts};
  return settle(std::move(beam), proof, config_.window_rays) == Sight::hidden;
}

bool Occlusion::find_open_line(const Beam& beam, Proof& proof, int rays,
                               std::vector<Suspect>& suspects) const {
  for (int k = 0; k < rays; ++k) {
    std::optional<BeamLine> line = draw_line(beam, proof.random);
    const bool within = line.has_value();
    if (!within) line = draw_any_line(beam, proof.random);
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

Occlusion::Barrier Occlusion::best_barrier(const Beam& beam,
                                           std::span<const Suspect> suspects) const {
  // A flat one hides nothing from itself: where it lies in the plane, it looks away from the rest.
  std::vector<std::uint32_t> ends;
  for (const BeamSide* side : {&beam.a, &beam.b}) {
    for (const BeamPart& part : side->parts) {
      if (part.number() != BeamPart::no_number && !planes_.is_flat(part.number()))
        ends.push_back(part.number());
    }
  }
  std::sort(ends.begin(), ends.end());
  Barrier best;
  for (const Suspect& suspect : suspects) {
    const auto found = crossing(beam, planes_.plane(suspect.plane), tolerance_m_);
    if (!found || found->region.size() < 3) continue;
    const double whole = area_m2(found->region);
    std::vector<Polygon> open =
        planes_.uncovered(suspect.plane, {found->region}, ends, config_.max_pieces);
    if (open.size() > config_.max_pieces) continue;
    double share = 0.0;
    for (const Polygon& p : open) share += area_m2(p) / whole;
    if (share < best.open_share)
      best = {suspect.plane, found->first, found->end, share, std::move(open)};
    if (best.open_share < 1.0 && best.windows.empty()) break;
  }
  return best;
}

Beam Occlusion::through(const Beam& beam, const Barrier& barrier, const Polygon& window) const {
  const Plane& plane = planes_.plane(barrier.plane);
  // The stop before it tells from which side the beam comes.
  const std::vector<Vec3>& last =
      barrier.first == 0 ? beam.a.points : beam.windows[barrier.first - 1].polygon;
  double farthest = 0.0;
  for (const Vec3& p : last) {
    const double d = plane.signed_distance(p);
    if (std::abs(d) > std::abs(farthest)) farthest = d;
  }
  Beam narrow = beam;
  const auto at = narrow.windows.begin();
  const auto next = narrow.windows.erase(at + static_cast<std::ptrdiff_t>(barrier.first),
                                         at + static_cast<std::ptrdiff_t>(barrier.end));
  narrow.windows.insert(next, {window, farthest > 0.0 ? -plane.n : plane.n});
  return narrow;
}

Sight Occlusion::settle(Beam beam, Proof& proof, int rays) const {
  if (!drop_averted(beam) || !tighten(beam, 1e-3 * tolerance_m_)) return Sight::hidden;
  std::vector<Suspect> suspects;
  if (find_open_line(beam, proof, rays, suspects)) return Sight::open;
  const std::size_t tried = std::min(suspects.size(), static_cast<std::size_t>(config_.max_planes));
  const Barrier barrier = best_barrier(beam, std::span(suspects).first(tried));
  if (barrier.windows.empty() && barrier.open_share < 1.0) return Sight::hidden;
  if (--proof.parts_left <= 0) return Sight::unknown;
  if (barrier.open_share > config_.most_open) return take_apart(beam, proof);
  Sight sight = Sight::hidden;
  for (const Polygon& window : barrier.windows) {
    const Sight one = settle(through(beam, barrier, window), proof, config_.rays);
    if (one == Sight::open) return one;
    if (one == Sight::unknown) sight = one;
    if (proof.parts_left <= 0) return Sight::unknown;
  }
  return sight;
}

// The longer side in the middle.
Sight Occlusion::take_apart(const Beam& beam, Proof& proof) const {
  const bool cut_a = beam.a.box.diagonal() >= beam.b.box.diagonal();
  const BeamSide& side = cut_a ? beam.a : beam.b;
  if (side.box.diagonal() <= smallest_m_) return Sight::unknown;
  Sight sight = Sight::hidden;
  for (std::vector<BeamPart>& half : halves_of(side)) {
    if (half.empty()) continue;
    Beam part = beam;
    (cut_a ? part.a : part.b) = side_of(std::move(half));
    const Sight one = settle(std::move(part), proof, config_.rays);
    if (one == Sight::open) return one;
    if (one == Sight::unknown) sight = one;
    if (proof.parts_left <= 0) return Sight::unknown;
  }
  return sight;
}

}  // namespace enfilade
