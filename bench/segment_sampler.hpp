// Random segments between the surfaces of a prepared run, held against its G_cluster.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "exact_sight.hpp"
#include "raycast/ray_scene.hpp"
#include "run/prepare.hpp"

namespace enfilade::bench {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// An unblocked segment whose clusters G_cluster does not join.
struct Miss {
  Pair clusters;
  Vec3 from{0.0}, to{0.0};
};

struct MissCount {
  std::uint64_t segments = 0;  ///< drawn between front sides
  std::uint64_t suspects = 0;  ///< that the ray tracer finds unblocked, without an edge
  std::vector<Miss> misses;    ///< those of them that are unblocked exactly
};

/// What so many segments for each pair of G_cluster find.
struct TightnessRound {
  std::uint64_t segments_a_pair = 0;
  std::size_t pairs_seen = 0;
};

class SegmentSampler {
 public:
  SegmentSampler(const Prepared& prepared, std::uint64_t seed);

  /// A third each: polygons drawn by area; clusters, each as likely as the next; clusters of cells
  /// that see each other. Pairs that G_cluster has are counted without a ray.
  MissCount find_misses(std::uint64_t segments);

  /// Doubles the segments of pairs not yet seen from `first` on, until that finds less than
  /// `stable_share` more, or beyond `most`.
  std::vector<TightnessRound> tightness(std::uint64_t first, std::uint64_t most,
                                        double stable_share);
  /// Pairs of G_cluster that the last call of `tightness` found no open line for.
  const std::vector<Pair>& unseen() const { return unseen_; }

 private:
  struct Entry {
    Plane plane;
    std::uint32_t cluster;
  };
  struct Segment {
    std::uint32_t from = 0, to = 0;  ///< polygons
    Vec3 a{0.0}, b{0.0};
  };

  std::uint32_t by_area(std::uint32_t first, std::uint32_t end);
  std::uint32_t of_cluster(std::uint32_t cluster);
  Pair of_seeing_cells();
  bool draw(std::uint32_t from, std::uint32_t to, Segment& segment);
  bool open(const Segment& segment) const;
  bool seen(const Pair& pair, std::uint64_t segments);

  const Prepared& prepared_;
  Random random_;
  std::vector<Polygon> polygons_;
  std::vector<Entry> entries_;
  std::vector<double> area_before_;              ///< sums; one more than polygons
  std::vector<std::uint32_t> first_of_cluster_;  ///< one more than clusters
  std::vector<std::vector<std::uint32_t>> in_cell_;
  std::vector<std::pair<CellId, CellId>> cells_;  ///< G_cell, where both have clusters
  std::vector<Pair> unseen_;
  RayScene rays_;
  ExactSight exact_;
};

}  // namespace enfilade::bench
