// Refinement: which pairs of nodes are linked, so that each link's error is below a tolerance.
#pragma once

#include <vector>

#include "radiosity/link_estimate.hpp"

namespace enfilade {

struct RefinementConfig {
  /// A link whose estimated error is above this is refined. Power: area times irradiance, the
  /// scene's unit times m2, in the worst band.
  double link_tolerance = 0.0;
  int max_depth = 20;        ///< binary splits below a polygon
  double min_area_m2 = 0.0;  ///< no patch is split below this
};

/// Refines the links of one receiving cluster. Splits its patches as it goes.
class LinkRefinement {
 public:
  LinkRefinement(ClusterState& receiver, std::span<const PointLight> lights,
                 const Occluders& occluders, const RefinementConfig& config, WorkCount& work);

  /// Appends to `kept` the link, or what it must be replaced by at today's light. `shooter`: the
  /// patches of link.shooter_cluster; null for a point light. Returns whether it was replaced.
  bool refine(const Link& link, std::span<const float> transport, const PatchForest* shooter,
              LinkSet& kept);

 private:
  LinkSide shooter_side(const Link& link, const PatchForest* shooter) const;
  bool fine_as_it_is(const Link& link, const PatchForest* shooter) const;
  void evaluate(Link link, const PatchForest* shooter, LinkSet& kept);
  bool splits_receiver(const LinkSide& receiver, const LinkSide& shooter,
                       const LinkEstimate& estimate, double variation_error) const;
  bool can_split(const LinkSide& side) const;
  void split(const LinkSide& receiver, const LinkSide& shooter, bool split_receiver);
  static void accept(Link link, const LinkSide& shooter, const LinkEstimate& estimate, bool finest,
                     LinkSet& kept);

  ClusterState& receiver_;
  std::span<const PointLight> lights_;
  const RefinementConfig& config_;
  WorkCount& work_;
  LinkEstimator estimator_;
  std::vector<Link> pending_;
};

}  // namespace enfilade
