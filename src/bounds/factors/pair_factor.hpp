// Bounds of the form factor between two polygons of a scene, with what stands between them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bounds/factors/open_factor.hpp"
#include "bounds/factors/pair_sight.hpp"
#include "bounds/factors/point_factor.hpp"
#include "geometry/shaft_tree.hpp"

namespace enfilade {

/// The number of no polygon, for a search that leaves none out.
constexpr std::uint32_t no_occluder = 0xFFFFFFFFu;

/// What bounds the light from a shooter j on a receiver i, per radiosity of the shooter.
struct PairFactor {
  Range mean;             ///< form factor from the receiver, mean over its area
  PointFactor at_points;  ///< form factor from each point of the receiver
  /// Standard deviation over the shooter of the kernel, averaged over the receiver, times the
  /// shooter's area, at most: the light's covariance with the kernel is at most this times the
  /// standard deviation of the radiosity.
  double mean_spread = 0.0;
  double point_spread = 0.0;  ///< the same for any one point of the receiver
  bool open = false;          ///< it is certain that nothing stands between the two
  bool none() const { return mean.hi <= 0.0; }
};

/// A part of one of the scene's polygons.
struct PatchOfPolygon {
  const FlatShape& shape;
  std::uint32_t polygon;  ///< the polygon's index
};

struct PairFactorConfig {
  /// Cuts of a viewer behind occluders, and of pairs that are close for their size, at most.
  int sight_depth = 2, near_depth = 16;
  /// Bounds of a factor are narrowed until they differ by this share of the factor without
  /// occluders (times the receiver's area).
  double sight_share = 0.05, near_share = 0.002;
  int point_parts = 2;  ///< a receiver has 2^this parts where its points' factors are bounded
  std::size_t most_occluders = 24;  ///< with more of them the shooter counts as unsure
};

/// All polygons of a scene as each other's occluders. What is thinner than the tolerance, 1e-7 of
/// the scene's extent, touches.
class PairFactors {
 public:
  /// `panes`: 1 for each polygon that light passes, dimmed: behind one a factor's lower bound is 0.
  /// Empty: there are none.
  explicit PairFactors(std::vector<Polygon> polygons, std::vector<char> panes = {},
                       const PairFactorConfig& config = {});

  /// Bounds from the receiver to the shooter. `known_open`: nothing stands between larger patches
  /// that hold these.
  PairFactor operator()(const PatchOfPolygon& receiver, const PatchOfPolygon& shooter,
                        bool known_open) const;
  double tolerance_m() const { return tolerance_m_; }
  const ShaftTree& tree() const { return tree_; }
  bool is_pane(std::uint32_t polygon) const { return !panes_.empty() && panes_[polygon] != 0; }

 private:
  struct Pair;
  Range occluded_flux(const Pair& pair, const FlatShape& viewer,
                      std::span<const std::uint32_t> among, double tolerance_m2, int depth) const;
  void bound_points(const FlatShape& receiver, const FlatShape& shooter, const SplitSight* sight,
                    PairFactor& factor) const;

  void bound_spreads(const FlatShape& receiver, const FlatShape& shooter, const FlatShape& r,
                     const FlatShape& s, PairFactor& factor) const;

  /// Polygons between two others: walls, then panes.
  struct Between {
    std::vector<const Polygon*> polygons;
    std::size_t panes = 0;
  };
  Between sorted(std::span<const std::uint32_t> between) const;

  PairFactorConfig config_;
  double tolerance_m_ = 0.0;
  std::vector<char> panes_;
  ShaftTree tree_;
};

}  // namespace enfilade
