#include "segment_sampler.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade::bench {
namespace {

std::vector<Polygon> all_polygons(const Prepared& prepared) {
  std::vector<Polygon> polygons;
  for (const Cluster& cluster : prepared.clusters) {
    for (const ClusterPolygon& p : cluster.polygons) polygons.push_back(p.polygon);
  }
  return polygons;
}

/// By area, so that no point comes from a triangle of a fan that is but a line.
Vec3 random_point(const Polygon& p, Random& random) {
  std::size_t k = 1;
  if (p.size() > 3) {
    double left = random.uniform() * glm::length(area_vector(p));
    const auto twice_area = [&] { return glm::length(glm::cross(p[k] - p[0], p[k + 1] - p[0])); };
    for (; k + 2 < p.size() && (left -= twice_area()) > 0.0; ++k) {
    }
  }
  const double s = std::sqrt(random.uniform()), t = random.uniform();
  return (1.0 - s) * p[0] + s * ((1.0 - t) * p[k] + t * p[k + 1]);
}

}  // namespace

SegmentSampler::SegmentSampler(const Prepared& prepared, std::uint64_t seed)
    : prepared_(prepared),
      random_(seed),
      polygons_(all_polygons(prepared)),
      in_cell_(prepared.cells.cells().size()),
      rays_(polygons_),
      exact_(polygons_) {
  area_before_.push_back(0.0);
  for (const Cluster& cluster : prepared.clusters) {
    first_of_cluster_.push_back(static_cast<std::uint32_t>(entries_.size()));
    in_cell_[cluster.cell.index()].push_back(cluster.id.value);
    for (const ClusterPolygon& p : cluster.polygons) {
      entries_.push_back({plane_of(p.polygon), cluster.id.value});
      area_before_.push_back(area_before_.back() + area_m2(p.polygon));
    }
  }
  first_of_cluster_.push_back(static_cast<std::uint32_t>(entries_.size()));
  cells_ = visible_cells(prepared.cells);
  std::erase_if(cells_, [&](const auto& pair) {
    return in_cell_[pair.first.index()].empty() || in_cell_[pair.second.index()].empty();
  });
}

std::uint32_t SegmentSampler::by_area(std::uint32_t first, std::uint32_t end) {
  const double low = area_before_[first], high = area_before_[end];
  const auto at = std::upper_bound(area_before_.begin() + first, area_before_.begin() + end,
                                   low + random_.uniform() * (high - low));
  return static_cast<std::uint32_t>(at - area_before_.begin()) - 1;
}

/// Small polygons get their share.
std::uint32_t SegmentSampler::of_cluster(std::uint32_t cluster) {
  const std::uint32_t first = first_of_cluster_[cluster], end = first_of_cluster_[cluster + 1];
  if (random_.below(2) == 0) return by_area(first, end);
  return first + static_cast<std::uint32_t>(random_.below(end - first));
}

Pair SegmentSampler::of_seeing_cells() {
  const auto& [a, b] = cells_[random_.below(cells_.size())];
  const auto &from = in_cell_[a.index()], &to = in_cell_[b.index()];
  return {of_cluster(from[random_.below(from.size())]), of_cluster(to[random_.below(to.size())])};
}

/// False where the ends do not lie before each other.
bool SegmentSampler::draw(std::uint32_t from, std::uint32_t to, Segment& segment) {
  segment = {from, to, random_point(polygons_[from], random_),
             random_point(polygons_[to], random_)};
  return entries_[from].plane.signed_distance(segment.b) > exact_.rounding_m() &&
         entries_[to].plane.signed_distance(segment.a) > exact_.rounding_m();
}

bool SegmentSampler::open(const Segment& s) const {
  return !rays_.occluded(s.a, s.b, s.from, s.to) && exact_.open(s.a, s.b, s.from, s.to);
}

MissCount SegmentSampler::find_misses(std::uint64_t segments) {
  MissCount count;
  const auto polygons = static_cast<std::uint32_t>(entries_.size());
  const std::size_t clusters = prepared_.clusters.size();
  const auto any_cluster = [&] {
    return of_cluster(static_cast<std::uint32_t>(random_.below(clusters)));
  };
  Segment s;
  for (std::uint64_t k = 0; count.segments < segments; ++k) {
    Pair ends;
    if (k % 3 == 0) {
      ends = {by_area(0, polygons), by_area(0, polygons)};
    } else {
      ends = k % 3 == 1 ? Pair{any_cluster(), any_cluster()} : of_seeing_cells();
    }
    const std::uint32_t a = entries_[ends.first].cluster, b = entries_[ends.second].cluster;
    ++count.segments;
    if (a == b || prepared_.graph.has_edge(a, b)) continue;
    if (!draw(ends.first, ends.second, s) || rays_.occluded(s.a, s.b, s.from, s.to)) continue;
    ++count.suspects;
    if (exact_.open(s.a, s.b, s.from, s.to)) count.misses.push_back({{a, b}, s.a, s.b});
  }
  return count;
}

bool SegmentSampler::seen(const Pair& pair, std::uint64_t segments) {
  Segment s;
  for (std::uint64_t k = 0; k < segments; ++k) {
    // One that does not face the other is drawn again, not for ever.
    bool drawn = false;
    for (int tries = 0; tries < 8 && !drawn; ++tries) {
      drawn = draw(of_cluster(pair.first), of_cluster(pair.second), s);
    }
    if (drawn && open(s)) return true;
  }
  return false;
}

std::vector<TightnessRound> SegmentSampler::tightness(std::uint64_t first, std::uint64_t most,
                                                      double stable_share) {
  std::vector<Pair>& left = unseen_;
  left.clear();
  for (std::uint32_t i = 0; i < prepared_.graph.size(); ++i) {
    for (const std::uint32_t j : prepared_.graph.neighbours(i)) {
      if (j > i) left.emplace_back(i, j);
    }
  }
  std::vector<TightnessRound> rounds;
  std::size_t found = 0;
  for (std::uint64_t done = 0, next = first; next <= most; done = next, next *= 2) {
    const std::size_t more =
        std::erase_if(left, [&](const Pair& pair) { return seen(pair, next - done); });
    found += more;
    rounds.push_back({next, found});
    if (static_cast<double>(more) < stable_share * static_cast<double>(found)) break;
  }
  return rounds;
}

}  // namespace enfilade::bench
