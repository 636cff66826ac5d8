// Importance against closed forms: what the walks hit first is a form factor, and further hits are
// a geometric series.
#include "solver/importance.hpp"

#include <gtest/gtest.h>

#include "geometry/form_factor.hpp"
#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

/// Importance times area of each polygon, of its sum; `reflectance` of all walls of a cube of 1 m.
struct Shares {
  Scene scene;
  std::vector<Cluster> clusters;
  Occluders occluders;
  std::vector<double> of;

  Shares(double reflectance, const Probe& point)
      : scene(testing::box_room({0, 0, 0}, {1, 1, 1}, {reflectance}, {0.0})),
        clusters(testing::clusters_of(scene)),
        occluders(clusters) {
    WorkCount work;
    ImportanceConfig config;
    config.everywhere = 0.0;
    config.walks = 1 << 18;
    const std::vector<float> importance =
        importance_to(std::vector<Probe>{point}, scene, clusters, occluders, work, config);
    double sum = 0.0;
    for (std::uint32_t k = 0; k < importance.size(); ++k) {
      of.push_back(importance[k] * area_m2(occluders.polygon(k)));
      sum += of.back();
    }
    for (double& share : of) share /= sum;
    EXPECT_GT(work.rays, 1u << 18);
  }
};

TEST(Importance, OfDarkWallsIsTheFormFactor) {
  const Probe point{{0.3, 0.4, 0.25}, {0, 0, 1}};
  const Shares shares(1e-4, point);
  for (std::uint32_t k = 0; k < shares.of.size(); ++k) {
    EXPECT_NEAR(shares.of[k], point_to_polygon(point.p, point.n, shares.occluders.polygon(k)),
                4e-3);
  }
}

TEST(Importance, OfWhiteWallsEndsAlikeEverywhere) {
  // After some 50 hits, of which the first alone favours the ceiling (0.55).
  const Shares shares(0.99, {{0.5, 0.5, 0.5}, {0, 0, 1}});
  for (const double share : shares.of) EXPECT_NEAR(share, 1.0 / 6.0, 0.012);
}

TEST(Importance, IsOnlyNeededForPoints) {
  const Scene scene = testing::box_room({0, 0, 0}, {1, 1, 1}, {0.5}, {0.0});
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  const Occluders occluders(clusters);
  WorkCount work;
  EXPECT_TRUE(importance_to({}, scene, clusters, occluders, work).empty());
  EXPECT_EQ(work.rays, 0u);
}

TEST(Importance, PointsThatSeeNothingAreCounted) {
  Scene scene = testing::box_room({0, 0, 0}, {1, 1, 1}, {0.5}, {0.0});
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  const Occluders occluders(clusters);
  const Vec3 up(0, 0, 1);
  const std::vector<Probe> points{
      {{0.5, 0.5, 0.5}, up}, {{0.5, 0.5, 0.0}, up}, {{0.5, 0.5, -0.1}, up}, {{9, 9, 9}, up}};
  EXPECT_EQ(blind_points(points, scene, occluders), 2u);
  scene.sky = Sky{};
  EXPECT_EQ(blind_points(points, scene, occluders), 1u);  // below the floor
}

}  // namespace
}  // namespace enfilade
