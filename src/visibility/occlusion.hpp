// Which clusters hide each other by what stands between them, where cells and portals leave it
// open.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "clusters/cluster.hpp"
#include "raycast/ray_scene.hpp"
#include "visibility/occluder_planes.hpp"
#include "visibility/portal_search.hpp"

namespace enfilade {

struct OcclusionConfig {
  int first_rays = 24;         ///< that look for an open line before anything is proved
  int rays = 6;                ///< for each part of the pair after that
  int max_parts = 48;          ///< a pair is taken apart into at most so many
  int max_planes = 3;          ///< planes tried for each part, those that stop most rays first
  double most_open = 0.6;      ///< of a plane; where more is open, the longer side is halved
  std::size_t max_pieces = 8;  ///< more openings in a plane are not followed one by one
  std::uint64_t seed = 1;
};

enum class Sight { open, hidden, unknown };

/// Proves that no line joins two clusters. Rays say which planes stand between; all lines cross
/// such a plane within the hull of the corner-to-corner crossings, and where polygons cover it, the
/// pair is hidden. What is left open there is a window: lines through it cross the next plane
/// within its penumbra. What cannot be proved whole is taken apart. `hidden` is a proof, to
/// rounding; `open` a line that was found; `unknown` neither.
class Occlusion {
 public:
  Occlusion(std::span<const Cluster> clusters, double tolerance_m, const OcclusionConfig& config);

  Sight between(std::uint32_t a, std::uint32_t b) const;

 private:
  struct Part {
    SourcePolygon shape;
    std::uint32_t polygon = 0;
  };
  /// A part of a cluster, and points whose hull holds it.
  struct Side {
    std::vector<Part> parts;
    Box box;
    std::vector<Vec3> points;
  };
  struct Suspect {
    std::uint32_t plane;
    int rays;
  };
  /// What the most covering plane leaves open.
  struct Barrier {
    std::uint32_t plane = 0;
    double open_share = 1.0;
    std::vector<Polygon> windows;
  };
  struct Proof {
    Random random;
    int parts_left;
  };

  Side side_of(std::vector<Part> parts) const;
  bool drop_averted(Side& a, Side& b) const;
  Sight settle(Side a, Side b, Proof& proof, int rays) const;
  bool find_open_line(const Side& a, const Side& b, Proof& proof, int rays,
                      std::vector<Suspect>& suspects) const;
  std::vector<Polygon> openings(const Side& a, const Side& b, std::uint32_t plane,
                                std::vector<Polygon> region) const;
  Polygon crossing(const Side& a, const Side& b, std::uint32_t plane) const;
  Barrier best_barrier(const Side& a, const Side& b, std::span<const Suspect> suspects) const;
  bool narrow(Side& a, Side& b, std::uint32_t plane, const Polygon& window) const;
  Sight take_apart(const Side& a, const Side& b, Proof& proof) const;

  OcclusionConfig config_;
  double tolerance_m_;
  double smallest_m_ = 0.0;
  std::vector<std::vector<Part>> clusters_;
  std::vector<Polygon> polygons_;
  OccluderPlanes planes_;
  RayScene rays_;
};

}  // namespace enfilade
