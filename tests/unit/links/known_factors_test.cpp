// Links and their refinement against the public set of form factors.
#include <gtest/gtest.h>

#include "links/link_refinement.hpp"
#include "unit/known_factors.hpp"

namespace enfilade {
namespace {

/// A receiver and a shooter of radiosity 1, linked by refinement with a tolerance of power.
struct Refined {
  Scene scene;
  std::vector<Cluster> clusters;
  Occluders occluders;
  ClusterState shooting, receiving;
  LinkSet links;
  double power = 0.0, error = 0.0;  ///< m2
  WorkCount work;

  Refined(const testing::KnownFactor& known, Basis basis, double tolerance_m2, OracleKind oracle)
      : scene(testing::scene_of(known)),
        clusters(testing::clusters_of(scene)),
        occluders(clusters),
        shooting(clusters.front(), scene, basis),
        receiving(clusters.back(), scene, basis),
        links(basis == Basis::linear ? 9 : 1) {
    RefinementConfig config;
    config.link_tolerance = tolerance_m2;
    config.min_area_m2 = 1e-12;
    config.max_depth = 24;
    config.oracle = oracle;
    LinkRefinement refinement(receiving, {}, nullptr, occluders, config, work);
    Link link;
    link.shooter_cluster = shooting.id();
    refinement.refine(link, &shooting.patches(), links);
    for (std::size_t i = 0; i < links.size(); ++i) {
      power += area_factor(receiving.patches(), links[i], links.transport(i));
      error += links[i].error;
    }
  }
};

double area_of(const testing::KnownFactor& known) { return area_m2(known.receiver); }

/// The smaller of both areas bounds what is exchanged.
double scale_of(const testing::KnownFactor& known) {
  return std::max(known.factor * area_of(known),
                  1e-3 * std::min(area_of(known), area_m2(known.shooter)));
}

TEST(LinkRefinement, FindsTheKnownFactors) {
  for (const Basis basis : {Basis::constant, Basis::linear}) {
    for (const testing::KnownFactor& known : testing::known_factors()) {
      if (known.from_point()) continue;
      const double want = known.factor * area_of(known), scale = scale_of(known);
      const Refined refined(known, basis, 3e-4 * scale, OracleKind::error);
      EXPECT_NEAR(refined.power, want, refined.error + 1e-6 * scale) << known.name;
      EXPECT_NEAR(refined.power, want, 0.02 * scale) << known.name;
      EXPECT_LT(refined.links.size(), 30000u) << known.name;
    }
  }
}

}  // namespace
}  // namespace enfilade
