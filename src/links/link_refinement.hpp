// Refinement of links (§3.3.2; Hanrahan, Salzman and Aupperle 1991): which pairs of nodes are
// linked, so that each link's error is below a tolerance.
#pragma once

#include <memory>
#include <vector>

#include "links/link_estimate.hpp"
#include "links/refinement_oracle.hpp"

namespace enfilade {

struct RefinementConfig {
  /// A link is refined where the oracle's error is above this. Power: area times irradiance, the
  /// scene's unit times m2, in the worst band.
  double link_tolerance = 0.0;
  int max_depth = 20;        ///< binary splits below a polygon
  double min_area_m2 = 0.0;  ///< no patch is split below this
  OracleKind oracle = OracleKind::error;
  VisibilityMethod visibility = VisibilityMethod::exact;
};

/// Refines the links of one receiving cluster. Splits the receiver's patches where links need it.
class LinkRefinement {
 public:
  LinkRefinement(ClusterState& receiver, std::span<const PointLight> lights,
                 const Occluders& occluders, const RefinementConfig& config, WorkCount& work);

  /// True where the link's error at the shooter's current light is within the tolerance or cannot
  /// be made smaller. `shooter`: the patches of link.shooter_cluster; null for a point light.
  bool accurate_enough(const Link& link, std::span<const float> transport,
                       const PatchForest* shooter) const;
  /// Refines a link that is not accurate enough: appends the links that replace it to `kept`, or
  /// none where no light can arrive.
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
