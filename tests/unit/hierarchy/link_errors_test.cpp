// Links' errors summed per patch, against sums by hand.
#include "hierarchy/link_errors.hpp"

#include <gtest/gtest.h>

#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

/// A block of six faces is one cluster, with groups above them. One link brings its error to the
/// whole of it, one to a face, one to half of that face.
TEST(LinkErrors, AddUpDownTheHierarchy) {
  Scene scene;
  scene.bands = 1;
  testing::add_block(scene, {0, 0, 0}, {2, 1, 1}, {0.5}, {0.0});
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  ClusterState state(clusters[0], scene, Basis::linear);
  PatchForest& patches = state.patches();
  const std::size_t half = patches.subdivide(0);
  for (std::size_t n = 0; n < patches.size(); ++n) patches.irradiance(n)[0] = 4.0;
  patches.irradiance(5)[0] = 0.0;
  const auto link_to = [](PatchId receiver) {
    Link link;
    link.receiver = receiver;
    return link;
  };
  LinkErrors errors;
  errors.add(patches, link_to(patches.root()), 1.0);  // over 10 m2
  errors.add(patches, link_to(patches.node(0).id), 0.6);
  errors.add(patches, link_to(patches.node(half).id), 0.3);
  errors.set(patches);
  const double area_m2 = patches.node(0).shape.area_m2;
  EXPECT_NEAR(patches.link_error(1), 0.1 / 4.0, 1e-7);
  EXPECT_NEAR(patches.link_error(half), (0.1 + 0.6 / area_m2 + 0.6 / area_m2) / 4.0, 1e-6);
  EXPECT_NEAR(patches.link_error(half + 1), (0.1 + 0.6 / area_m2) / 4.0, 1e-6);
  EXPECT_EQ(patches.link_error(5), 0.0f);  // no light, no share of it

  // A file keeps them, and the halves of a patch begin with what it had.
  const ClusterState read(state.bytes_of(Section::geometry), state.bytes_of(Section::patches), {});
  for (std::size_t n = 0; n < patches.size(); ++n)
    EXPECT_EQ(read.patches().link_error(n), patches.link_error(n));
  const std::size_t quarter = patches.subdivide(half);
  EXPECT_EQ(patches.link_error(quarter), patches.link_error(half));
}

}  // namespace
}  // namespace enfilade
