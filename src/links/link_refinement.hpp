// Refinement of links (§3.3.2; Hanrahan, Salzman and Aupperle 1991): which pairs of nodes are
// linked, so that each link's error is below a tolerance.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "links/link_estimate.hpp"
#include "links/refinement_oracle.hpp"
#include "occluders/receiver_importance.hpp"

namespace enfilade {

struct RefinementConfig {
  /// A link is refined where the oracle's error is above this. Power: area times irradiance, the
  /// scene's unit times m2, in the worst band.
  double link_tolerance = 0.0;
  /// Importance of each polygon, by its global number: the tolerance of a link is link_tolerance
  /// over that of its receiver. Empty = 1 everywhere.
  std::span<const float> importance{};
  /// Estimate all links from far nodes anew: they were estimated with the distribution of light
  /// over each node as it was then.
  bool renew_far = false;
  int max_depth = 20;        ///< binary splits below a polygon
  double min_area_m2 = 0.0;  ///< no patch is split below this
  OracleKind oracle = OracleKind::error;
  VisibilityMethod visibility = VisibilityMethod::exact;
};

/// Refines the links of one receiving cluster. Splits the receiver's patches where links need it.
class LinkRefinement {
 public:
  /// `far`: the receiver's view of the far field; null where all shooters are clusters and lights.
  LinkRefinement(ClusterState& receiver, std::span<const LightSource> lights, const FarView* far,
                 const Occluders& occluders, const RefinementConfig& config, WorkCount& work);

  /// True where the link's error at the shooter's current light is within the tolerance or cannot
  /// be made smaller. `shooter`: the patches of link.shooter_cluster; null for a point light and a
  /// far node.
  bool accurate_enough(const Link& link, std::span<const float> transport,
                       const PatchForest* shooter) const;
  /// Refines a link that is not accurate enough: appends the links that replace it to `kept`, or
  /// none where no light can arrive.
  void refine(const Link& link, const PatchForest* shooter, LinkSet& kept);
  /// Returns the links to whole clusters that replace links to far nodes, so far; they are not
  /// evaluated yet.
  std::vector<Link>& near_links() { return near_links_; }
  /// Returns the importance of a node of the receiver.
  double importance(PatchId receiver) const { return importance_.of(receiver); }

 private:
  LinkSide shooter_side(const Link& link, const PatchForest* shooter,
                        const LinkSide& receiver) const;
  NodeLight light_of(const Link& link, const PatchForest* shooter) const;
  double tolerance(PatchId receiver) const {
    return config_.link_tolerance / importance_.of(receiver);
  }
  bool must_open(const LinkSide& receiver, const LinkSide& shooter, double bound) const;
  void open(const LinkSide& receiver, const LinkSide& shooter);
  void evaluate(Link link, const LinkEstimator::Between& among, const PatchForest* shooter,
                LinkSet& kept);
  bool can_split(const LinkSide& side) const;
  void split(const LinkSide& receiver, const LinkSide& shooter, bool split_receiver,
             const LinkEstimator::Between& between);
  static void describe(Link& link, const LinkSide& shooter, const LinkEstimate& estimate);

  ClusterState& receiver_;
  std::span<const LightSource> lights_;
  const FarView* far_;
  const RefinementConfig& config_;
  WorkCount& work_;
  LinkEstimator estimator_;
  ReceiverImportance importance_;
  std::unique_ptr<RefinementOracle> oracle_;
  struct Pending {
    Link link;
    LinkEstimator::Between among;
  };
  std::vector<Pending> pending_;
  std::vector<Link> near_links_;
};

}  // namespace enfilade
