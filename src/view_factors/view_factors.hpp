// View factors between surfaces or groups of them, with visibility, for programs of heat radiation.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "clusters/cluster.hpp"
#include "occluders/occluders.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Groups of polygons: what a view factor leads from and to.
struct ViewFactorGroups {
  std::vector<std::string> names;
  std::vector<std::uint32_t> of_polygon;  ///< by global polygon; `none` for those that only hide
  static constexpr std::uint32_t none = 0xFFFFFFFFu;
};

struct ViewFactorConfig {
  /// Quadrature: the sum over a row of the errors of its factors to reach, and the most points on
  /// one polygon to reach it with.
  double error = 3e-4;
  int most_points = 4096;
  /// Above 0: so many rays from each group in place of the quadrature, whose cost grows with the
  /// square of the polygons.
  int rays = 0;
  std::uint64_t seed = 1;
};

/// The matrix of view factors of n groups.
struct ViewFactors {
  std::vector<std::string> names;
  std::vector<double> area_m2;  ///< less what bodies that stand on it cover
  std::vector<double> factor;   ///< [from * n + to], symmetric times area: A_i F_ij = A_j F_ji
  std::vector<double> error;    ///< [from * n + to], estimated, one standard deviation or so
  /// Of each row: its sum as computed, before reciprocity and closure.
  std::vector<double> sum_before;
  /// Rows that end on front sides everywhere but for 1e-3: they are closed, to sum to 1.
  std::vector<bool> closed;
  double largest_closure = 0.0;  ///< the largest change of a factor by reciprocity and closure
  std::size_t size() const { return names.size(); }
};

/// Computes the factors on all cores. Rows come from the closed form of the visible part of each
/// polygon from points of the group, by adaptive cubature over its triangles, or by rays. A_i F_ij
/// and A_j F_ji are averaged by their errors, and closed rows scaled, symmetrically, to sum to 1
/// (as Sinkhorn and Knopp 1967 do). What faces nothing, and the backs of surfaces, is in no row.
ViewFactors view_factors(const Scene& scene, std::span<const Cluster> clusters,
                         const Occluders& occluders, const ViewFactorGroups& groups,
                         const ViewFactorConfig& config, const Progress& progress = {});

/// Makes the rows of `computed` reciprocal and closes those that are closed; sets
/// `largest_closure`. `computed.factor` holds each row as it was computed.
void make_reciprocal(ViewFactors& computed);

}  // namespace enfilade
