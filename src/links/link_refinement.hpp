// Refinement: which pairs of nodes are linked, so that each link's error is below a tolerance.
#pragma once

#include <memory>
#include <vector>

#include "links/link_estimate.hpp"
#include "links/refinement_oracle.hpp"

namespace enfilade {

struct RefinementConfig {
  /// A link that the oracle doubts more than this is refined. Power: area times irradiance, the
  /// scene's unit times m2, in the worst band.
  double link_tolerance = 0.0;
  int max_depth = 20;        ///< binary splits below a polygon
  double min_area_m2 = 0.0;  ///< no patch is split below this
  OracleKind oracle = OracleKind::error;
  VisibilityMethod visibility = VisibilityMethod::exact;
};

/// Refines the links of one receiving cluster. Splits its patches as it goes.
class LinkRefinement {
 public:
  LinkRefinement(ClusterState& receiver, std::span<const PointLight> lights,
                 const Occluders& occluders, const RefinementConfig& config, WorkCount& work);

  /// May the link stay as it is at today's light? `shooter`: the patches of link.shooter_cluster;
  /// null for a point light.
  bool fine_as_it_is(const Link& link, std::span<const float> transport,
                     const PatchForest* shooter) const;
  /// For a link that may not: appends to `kept` what takes its place, which may be nothing.
  void refine(const Link& link, const PatchForest* shooter, LinkSet& kept);

 private:
  LinkSide shooter_side(const Link& link, const PatchForest* shooter) const;
  void evaluate(Link link, const LinkEstimator::Between& among, const PatchForest* shooter,
                LinkSet& kept);
  bool can_split(const LinkSide& side) const;
  void split(const LinkSide& receiver, const LinkSide& shooter, bool split_receiver,
             const LinkEstimator::Between& between);
  static void describe(Link& link, const LinkSide& shooter, const LinkEstimate& estimate);

  ClusterState& receiver_;
  std::span<const PointLight> lights_;
  const RefinementConfig& config_;
  WorkCount& work_;
  LinkEstimator estimator_;
  std::unique_ptr<RefinementOracle> oracle_;
  struct Pending {
    Link link;
    LinkEstimator::Between among;
  };
  std::vector<Pending> pending_;
};

}  // namespace enfilade
