// Which clusters hide each other by what stands between them, where cells and portals leave it
// open.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "clusters/cluster.hpp"
#include "raycast/ray_scene.hpp"
#include "visibility/line_space.hpp"
#include "visibility/occluder_planes.hpp"
#include "visibility/portal_search.hpp"

namespace enfilade {

struct OcclusionConfig {
  int first_rays = 8;               ///< that look for an open line before anything is proved
  int rays = 5;                     ///< for each part of the pair after that
  int max_parts = 64;               ///< a pair is taken apart into at most so many,
  int max_depth = 12;               ///< one within the other at most so often
  int min_parts = 8;                ///< where a pair's share is less, no pair is tried
  std::size_t all_parts = 4000000;  ///< that all pairs share: a large building's windows must do
  int window_rays = 4;              ///< as first_rays, for a cluster and a portal
  int window_parts = 4;             ///< as max_parts, for a cluster and a portal
  int window_planes = 2;            ///< as max_planes, for a cluster and a portal
  std::size_t window_path = 4;      ///< as many windows on the way, the last ones, narrow the lines
  int max_planes = 5;               ///< tried for each part, those that stop most rays first
  double most_open = 0.8;           ///< of a plane; where more is open, a side is taken apart
  std::size_t max_pieces = 8;       ///< more openings in a plane are not followed one by one
  std::uint64_t seed = 1;
};

enum class Sight { open, hidden, unknown };

/// Proves that no line joins two clusters. Rays say which planes stand between; all lines cross
/// such a plane within the hull of the corner-to-corner crossings, and where polygons cover it, the
/// pair is hidden. What is left open there is a window; the lines through it are a narrower lines,
/// which the next plane may stop. What cannot be proved whole is taken apart, first along a plane
/// that stops many rays and has a part of the pair on either side. `hidden` is a proof,
/// to rounding; `open` a line that was found; `unknown` neither.
class Occlusion {
 public:
  Occlusion(std::span<const Cluster> clusters, double tolerance_m, const OcclusionConfig& config);

  Sight between(std::uint32_t a, std::uint32_t b, int max_parts) const;
  /// Is the window hidden from all of the source, for lines through the last windows before it?
  /// These are portals, good to the cells' tolerance.
  bool is_hidden(const WindowView& view) const;

 private:
  struct Suspect {
    std::uint32_t plane;
    int rays;
  };
  /// What the most covering plane leaves open.
  struct Barrier {
    std::uint32_t plane = 0;
    std::size_t first = 0, end = 0;  ///< windows that it takes the place of
    double open_share = 1.0;
    std::vector<Polygon> windows;
  };
  struct Proof {
    Random random;
    int parts_left, max_planes;
    int depth = 0;
  };

  Sight settle(LineSpace lines, Proof& proof, int rays) const;
  bool find_open_line(const LineSpace& lines, Proof& proof, int rays,
                      std::vector<Suspect>& suspects) const;
  Barrier best_barrier(const LineSpace& lines, std::span<const Suspect> suspects) const;
  LineSpace through(const LineSpace& lines, const Barrier& barrier, const Polygon& window) const;
  Sight take_apart(const LineSpace& lines, std::span<const Suspect> suspects, Proof& proof) const;
  Sight settle(const LineSpace& lines, bool cut_a,
               std::array<std::vector<LineSpacePart>, 2>& halves, Proof& proof) const;

  OcclusionConfig config_;
  double tolerance_m_;
  double smallest_m_ = 0.0;
  std::vector<std::vector<LineSpacePart>> clusters_;
  std::vector<Polygon> polygons_;
  OccluderPlanes planes_;
  RayScene rays_;
};

}  // namespace enfilade
