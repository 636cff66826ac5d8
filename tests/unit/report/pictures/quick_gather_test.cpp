// The light of many lamps at a place of a picture, none of which gives much of it.
#include <gtest/gtest.h>

#include "geometry/form_factor.hpp"
#include "report/pictures/gathered_light.hpp"
#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

TEST(QuickGather, ManySmallLampsGiveAllTheirLight) {
  Scene scene;
  const auto add = [&](double x, double y, double z, double edge, double exitance) {
    Surface surface;
    surface.vertices = {{x, y, z}, {x, y + edge, z}, {x + edge, y + edge, z}, {x + edge, y, z}};
    surface.reflectance = {0.0};
    surface.exitance = {exitance};
    scene.surfaces.push_back(surface);
  };
  constexpr int side = 8;
  for (int i = 0; i < side * side; ++i)
    add(-4.0 + i % side, -4.0 + i / side, 3.0, 0.2, 50.0 + i);  // they face down
  add(-20.0, -20.0, 9.0, 40.0, 0.0);  // most of all area: lamps are bright
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  const Occluders occluders(clusters);
  const CellComplex cells;
  std::vector<ClusterState> states;
  for (const Cluster& c : clusters) states.emplace_back(c, scene, Basis::constant);
  const SolvedScene solved{scene, cells, clusters, states, occluders};
  const QuickGather gather(solved, 16);

  const Vec3 p(0.4, -0.7, 0.0), up(0, 0, 1);
  double want = 0.0;
  for (const Surface& lamp : scene.surfaces)
    want += lamp.exitance[0] * point_to_polygon(p, up, lamp.vertices);
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    std::vector<double> e{0.0};
    gather.add_direct(p, up, RayScene::no_polygon, random, e);
    EXPECT_NEAR(e[0], want, 0.01 * want);
  }
}

}  // namespace
}  // namespace enfilade
