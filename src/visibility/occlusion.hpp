// Occlusion culling: which pairs of clusters that cells and portals leave open are hidden by the
// polygons between them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "clusters/cluster.hpp"
#include "raycast/ray_scene.hpp"
#include "visibility/line_space.hpp"
#include "visibility/occluder_planes.hpp"
#include "visibility/portal_search.hpp"

namespace enfilade {

struct OcclusionConfig {
  int first_rays = 8;               ///< rays that test for an open line before anything is proved
  int rays = 5;                     ///< rays for each part of a pair that is subdivided
  int max_parts = 64;               ///< a pair is subdivided into at most this many parts
  int max_depth = 12;               ///< ... which are nested at most this deep
  int min_parts = 8;                ///< no pair is tried where fewer parts are left for each
  std::size_t all_parts = 4000000;  ///< parts of all pairs together: bounds the time of a building
  int window_rays = 4;              ///< first_rays, for a cluster and a portal
  int window_parts = 4;             ///< max_parts, for a cluster and a portal
  int window_planes = 2;            ///< max_planes, for a cluster and a portal
  std::size_t window_path = 4;  ///< the last windows before a portal that narrow the lines to it
  int max_planes = 5;           ///< planes tried for each part, those that stop most rays first
  double most_open = 0.8;       ///< open share of a plane above which a side is subdivided
  std::size_t max_pieces = 8;   ///< openings of one plane that are followed one by one
  std::uint64_t seed = 1;
};

enum class Sight { open, hidden, unknown };

/// Proves that no line joins two clusters. Rays find the planes that stand between; all lines cross
/// such a plane within the hull of the corner-to-corner crossings, and where polygons cover that
/// hull, the pair is hidden. Each opening left there is a window, and the lines through it are a
/// smaller line space, which the next plane may stop. A line space that no plane stops is
/// subdivided, first along a plane that stops many rays and has a part of the pair on either side.
/// `hidden` is a proof, to rounding; `open` means that a line was found; `unknown` neither.
class Occlusion {
 public:
  Occlusion(std::span<const Cluster> clusters, double tolerance_m, const OcclusionConfig& config);

  /// Of clusters a and b, with at most `max_parts` subdivisions.
  Sight between(std::uint32_t a, std::uint32_t b, int max_parts) const;
  /// Is the window hidden from all of the source, for lines through the last windows before it?
  /// Windows are portals, exact to the cells' tolerance only, so that they are taken larger by it.
  bool is_hidden(const WindowView& view) const;

 private:
  /// A plane that stopped rays, and how many.
  struct Suspect {
    std::uint32_t plane;
    int rays;
  };
  /// The plane that covers most of a line space, and the windows that it leaves open.
  struct Barrier {
    std::uint32_t plane = 0;
    std::size_t first = 0, end = 0;  ///< windows of the line space that these replace
    double open_share = 1.0;
    std::vector<Polygon> windows;
  };
  /// The state of one proof: its random numbers and the effort that is left.
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
  Sight subdivide(const LineSpace& lines, std::span<const Suspect> suspects, Proof& proof) const;
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
