// One row of view factors at a time: from a point in closed form, or from a polygon.
#pragma once

#include <span>
#include <vector>

#include "final_gather/visible_nodes.hpp"
#include "hierarchy/cluster_state.hpp"
#include "view_factors/view_factors.hpp"

namespace enfilade {

/// Sums over a polygon: of factors times area, and of their errors, m2, by group.
struct RowSum {
  std::vector<double> factor_m2, error_m2;
  double covered_m2 = 0.0;  ///< of the polygon, where it sees nothing but the inside of a body
  explicit RowSum(std::size_t groups) : factor_m2(groups, 0.0), error_m2(groups, 0.0) {}
  void add(const RowSum& other);
};

/// Makes rows for polygons. Has scratch memory of its own: one for each thread.
class RowSource {
 public:
  RowSource(std::span<const ClusterState> states, const Occluders& occluders,
            const ViewFactorGroups& groups, const ViewFactorConfig& config);

  /// Returns the row of polygon `own` (global number), by quadrature.
  RowSum by_quadrature(std::uint32_t own);
  /// The same by `rays` rays.
  RowSum by_rays(std::uint32_t own, int rays);

 private:
  struct Part;
  std::vector<double> row_at(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random);
  Part part_of(const Polygon& triangle, std::uint32_t own, Random& random);

  std::span<const ClusterState> states_;
  const Occluders& occluders_;
  const ViewFactorGroups& groups_;
  const ViewFactorConfig& config_;
  VisibleNodes visible_;
};

}  // namespace enfilade
