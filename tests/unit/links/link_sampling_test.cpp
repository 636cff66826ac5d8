// Visibility of links by random rays, and links to groups: t-tests over many links, each of which
// has rays of its own.
#include <gtest/gtest.h>

#include "geometry/form_factor.hpp"
#include "links/link_estimate.hpp"
#include "unit/gather/box_room.hpp"
#include "unit/statistics.hpp"

namespace enfilade {
namespace {

Surface sampled_sheet(Vec2 lo, Vec2 hi, double z, bool up, double exitance = 0.0) {
  Surface s;
  s.vertices = {{lo.x, lo.y, z}, {hi.x, lo.y, z}, {hi.x, hi.y, z}, {lo.x, hi.y, z}};
  if (!up) std::reverse(s.vertices.begin(), s.vertices.end());
  s.reflectance = {0.5};
  s.exitance = {exitance};
  return s;
}

/// A shooter at height 1 of the unit square, and a sheet at height 1/2 that ends at `edge`. What a
/// point at x sees of the shooter lies beyond 2 edge - x.
struct HalfHidden {
  Scene scene;
  std::vector<Cluster> clusters;
  Occluders occluders;
  std::vector<ClusterState> states;
  WorkCount work;

  HalfHidden(std::vector<Surface> receivers, double edge)
      : scene(scene_of(std::move(receivers), edge)),
        clusters(testing::clusters_of(scene)),
        occluders(clusters) {
    for (const Cluster& c : clusters) states.emplace_back(c, scene, Basis::constant);
  }
  static Scene scene_of(std::vector<Surface> receivers, double edge) {
    Scene scene;
    scene.bands = 1;
    scene.surfaces = std::move(receivers);
    scene.surfaces.push_back(sampled_sheet({0, 0}, {1, 1}, 1, false, 1.0));
    scene.surfaces.push_back(sampled_sheet({-9, -9}, {edge, 9}, 0.5, true));
    return scene;
  }
  const ClusterState& shooter() const { return states[states.size() - 2]; }
};

double seen_from(double x, double edge) { return std::clamp(1.0 - (2.0 * edge - x), 0.0, 1.0); }

/// Small parts of a receiver, each linked to the whole shooter by 1, 4 and 16 rays: on average a
/// ray is as often open as the shooter's area is seen.
TEST(LinkVisibility, RaysAreUnbiased) {
  const HalfHidden pair({sampled_sheet({0, 0}, {1, 1}, 0, true)}, 0.5);
  struct Case {
    double tolerance;
    std::uint64_t rays;
  };
  for (const Case& one : {Case{1.0, 1}, Case{1e-4, 4}, Case{1e-9, 16}}) {
    WorkCount work;
    LinkEstimator estimator(pair.occluders, VisibilityMethod::rays, work);
    const LinkSide shooter = LinkSide::of(pair.shooter().patches(), pair.shooter().id(), {});
    testing::Samples off;
    constexpr std::uint32_t parts = 4096;
    for (std::uint32_t path = parts; path < 2 * parts; ++path) {
      const LinkSide part = LinkSide::of(pair.states[0].patches(), ClusterId(0u), {0, path});
      const LinkEstimate link = estimator.evaluate(part, shooter, one.tolerance, nullptr);
      const double open = point_to_polygon(part.center, {0, 0, 1}, shooter.corners);
      off.add(link.transport[0] / open - seen_from(part.center.x, 0.5));
    }
    EXPECT_EQ(work.rays, one.rays * parts);
    EXPECT_GT(off.variance(), 0.0);
    EXPECT_TRUE(testing::has_mean(off, 0.0, 3, 1e-3)) << one.rays << " rays";
  }
}

/// The uncertainty of a link's visibility is that of its rays: not less than what it errs by.
TEST(LinkVisibility, UncertaintyOfRaysIsNotTooSmall) {
  const HalfHidden pair({sampled_sheet({0, 0}, {1, 1}, 0, true)}, 0.5);
  for (const double tolerance : {1.0, 1e-4, 1e-9}) {
    WorkCount work;
    LinkEstimator estimator(pair.occluders, VisibilityMethod::rays, work);
    const LinkSide shooter = LinkSide::of(pair.shooter().patches(), pair.shooter().id(), {});
    double off2 = 0.0, told2 = 0.0;
    for (std::uint32_t path = 4096; path < 8192; ++path) {
      const LinkSide part = LinkSide::of(pair.states[0].patches(), ClusterId(0u), {0, path});
      const LinkEstimate link = estimator.evaluate(part, shooter, tolerance, nullptr);
      const double open = part.area_m2 * point_to_polygon(part.center, {0, 0, 1}, shooter.corners);
      const double off = part.area_m2 * link.transport[0] - open * seen_from(part.center.x, 0.5);
      off2 += off * off;
      told2 += link.shooter_error * link.shooter_error;
    }
    EXPECT_GT(told2, 0.8 * off2) << tolerance;
    EXPECT_LT(told2, 30.0 * off2) << tolerance;
  }
}

/// What a group receives: its transport is the irradiance of a plane that faces the shooter, times
/// each polygon's cosine.
double group_power(const ClusterState& receiving, const LinkEstimate& link, PatchId group) {
  Link named;
  named.receiver = group;
  return area_factor(receiving.patches(), named, link.transport);
}

/// Far below a lamp, a group of tiles that lean this way and that: in the open it receives the sum
/// of what its tiles do, to a few hundredths; behind a sheet the share that is seen, on average.
TEST(LinkEstimator, AGroupReceivesWhatItsPolygonsDo) {
  constexpr int groups = 400;
  const double low = -6.0;
  std::vector<Surface> tiles;
  for (int g = 0; g < groups; ++g) {
    for (int k = 0; k < 3; ++k) {
      const double x = 0.3 * (g % 20) - 2.5, y = 0.3 * (g / 20) - 2.5, lean = 0.05 * (k - 1);
      Surface tile =
          sampled_sheet({x + 0.05 * k, y}, {x + 0.05 * k + 0.04, y + 0.04}, low + 0.03 * k, true);
      tile.vertices[1].z += lean * 0.4;
      tile.vertices[2].z += lean * 0.4;
      tile.object = "tiles " + std::to_string(g);
      tiles.push_back(tile);
    }
  }
  for (const double edge : {-9.0, 0.4}) {
    HalfHidden field(tiles, edge);
    WorkCount work;
    LinkEstimator estimator(field.occluders, VisibilityMethod::exact, work);
    const LinkSide shooter = LinkSide::of(field.shooter().patches(), field.shooter().id(), {});
    testing::Samples ratio_off;
    double received = 0.0, truth = 0.0;
    for (std::size_t g = 0; g < groups; ++g) {
      const ClusterState& state = field.states[g];
      const PatchId root = state.patches().root();
      ASSERT_TRUE(root.is_group());
      const LinkSide side = LinkSide::of(state.patches(), state.id(), root);
      const LinkEstimate link = estimator.evaluate(side, shooter, 1.0, nullptr);
      double exact = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const PolygonFrame& frame = state.patches().frames()[k];
        const Vec3 x = frame.origin;
        // The sheet's edge as seen from x, on the shooter.
        const double t = (1.0 - x.z) / (0.5 - x.z);
        const double from = std::clamp(x.x + t * (edge - x.x), 0.0, 1.0);
        Polygon seen = shooter.corners;
        for (Vec3& corner : seen) corner.x = std::max(corner.x, from);
        if (from < 1.0)
          exact += state.patches().node(k).shape.area_m2 * point_to_polygon(x, frame.n, seen);
      }
      const double power = group_power(state, link, root);
      ratio_off.add((power - exact) * 1e3);
      received += power;
      truth += exact;
    }
    ASSERT_GT(truth, 0.0);
    if (edge < -1.0) {
      EXPECT_NEAR(received / truth, 1.0, 0.02);
    } else {
      EXPECT_TRUE(testing::has_mean(ratio_off, 0.0, 1, 0.01 * truth / groups * 1e3));
      EXPECT_NEAR(received / truth, 1.0, 0.05);
    }
  }
}

}  // namespace
}  // namespace enfilade
