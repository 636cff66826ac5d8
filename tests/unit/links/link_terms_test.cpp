// What a link's estimate is made of, term by term, against quadrature.
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/form_factor.hpp"
#include "links/link_estimate.hpp"
#include "unit/gather/box_room.hpp"
#include "unit/links/sheet.hpp"

namespace enfilade {
namespace {

constexpr double rounding = 1e-12;  // tolerance of power

using testing::sheet;

/// A receiver that faces up, a shooter that faces down, and what stands between.
struct Sheets {
  Scene scene;
  std::vector<Cluster> clusters;
  Occluders occluders;
  ClusterState receiving, shooting;
  WorkCount work;
  LinkEstimate estimate;

  Sheets(const Surface& receiver, const Surface& shooter, const std::vector<Surface>& between,
         Basis basis, double tolerance = rounding)
      : scene(scene_of(receiver, shooter, between)),
        clusters(testing::clusters_of(scene)),
        occluders(clusters),
        receiving(clusters[0], scene, basis),
        shooting(clusters[1], scene, basis) {
    LinkEstimator estimator(occluders, VisibilityMethod::exact, work);
    estimate =
        estimator.evaluate(LinkSide::of(receiving.patches(), ClusterId(0u), {}),
                           LinkSide::of(shooting.patches(), ClusterId(1u), {}), tolerance, nullptr);
  }
  static Scene scene_of(const Surface& receiver, const Surface& shooter,
                        const std::vector<Surface>& between) {
    Scene scene;
    scene.bands = 1;
    scene.surfaces = {receiver, shooter};
    scene.surfaces.insert(scene.surfaces.end(), between.begin(), between.end());
    return scene;
  }
  /// Irradiance at a point of the receiver by a radiosity of 1, and of the place along the axes of
  /// the shooter's polygon; what lies below `edge` at half the height is hidden.
  std::array<double, 3> irradiance_at(const Vec3& x, double edge) const {
    const PatchForest& patches = shooting.patches();
    const PolygonFrame& frame = patches.frames()[0];
    const Polygon& corners = clusters[1].polygons[0].polygon;
    Vec3 lo = corners[0], hi = corners[0];
    for (const Vec3& c : corners) {
      lo = glm::min(lo, c);
      hi = glm::max(hi, c);
    }
    constexpr int side = 160;
    std::array<double, 3> sum{};
    for (int i = 0; i < side; ++i) {
      for (int j = 0; j < side; ++j) {
        const Vec3 y(lo.x + (hi.x - lo.x) * (i + 0.5) / side,
                     lo.y + (hi.y - lo.y) * (j + 0.5) / side, lo.z);
        if (0.5 * (x.x + y.x) < edge) continue;
        const double k = point_kernel(x, {0, 0, 1}, y, {0, 0, -1}) * (hi.x - lo.x) * (hi.y - lo.y) /
                         (side * side);
        const Vec2 place = frame.project(y) - patches.node(0).shape.centroid;
        sum[0] += k;
        sum[1] += k * place.x;
        sum[2] += k * place.y;
      }
    }
    return sum;
  }
  /// The affine functions that fit irradiance_at best over the receiver: row by row as a link's
  /// transport. The receiver is a rectangle, so that the fit's terms are independent.
  std::array<double, 9> best_transport(double edge) const {
    const PatchForest& patches = receiving.patches();
    const PolygonFrame& frame = patches.frames()[0];
    const PatchShape& shape = patches.node(0).shape;
    constexpr int side = 8;
    std::array<double, 9> fit{};
    Vec2 square(0.0), lo = shape.vertices[0], hi = lo;
    for (const Vec2& v : shape.vertices) {
      lo = glm::min(lo, v);
      hi = glm::max(hi, v);
    }
    for (int i = 0; i < side; ++i) {
      for (int j = 0; j < side; ++j) {
        const Vec2 q(lo.x + (hi.x - lo.x) * (i + 0.5) / side,
                     lo.y + (hi.y - lo.y) * (j + 0.5) / side);
        const Vec2 d = q - shape.centroid;
        const std::array<double, 3> e = irradiance_at(frame.at(q), edge);
        for (std::size_t s = 0; s < 3; ++s) {
          fit[s] += e[s] / (side * side);
          fit[3 + s] += e[s] * d.x;
          fit[6 + s] += e[s] * d.y;
        }
        square += d * d;
      }
    }
    for (std::size_t s = 0; s < 3; ++s) {
      fit[3 + s] /= square.x;
      fit[6 + s] /= square.y;
    }
    return fit;
  }
};

void expect_transport(const Sheets& sheets, double edge) {
  const std::array<double, 9> want = sheets.best_transport(edge);
  double scale[3] = {0.0, 0.0, 0.0};  // by the receiver's term
  for (std::size_t i = 0; i < 9; ++i) scale[i / 3] = std::max(scale[i / 3], std::abs(want[i]));
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(sheets.estimate.transport[i], want[i], 0.03 * scale[i / 3])
        << "receiver's term " << i / 3 << ", shooter's " << i % 3;
  }
}

/// Beside each other and of unlike sides, so that no coefficient vanishes by symmetry.
TEST(LinkTransport, OfAnOpenPairIsTheBestFit) {
  const Sheets sheets(sheet({0.1, 0.2}, {0.5, 0.4}, 0, true),
                      sheet({0.7, 0.5}, {1.1, 1.0}, 1, false), {}, Basis::linear);
  expect_transport(sheets, -9.0);
}

/// The visible part's light comes from another place than the shooter's middle.
TEST(LinkTransport, OfAHalfHiddenPairIsTheBestFit) {
  const double edge = 0.55;
  const Sheets sheets(sheet({0.1, 0.2}, {0.3, 0.3}, 0, true),
                      sheet({0.5, 0.5}, {1.3, 1.1}, 1, false),
                      {sheet({-5, -5}, {edge, 5}, 0.5, true)}, Basis::linear);
  ASSERT_EQ(sheets.work.rays, 0u);
  expect_transport(sheets, edge);
}

/// The light of a small shooter peaks between the receiver's points; the total is that of its own
/// factor, by reciprocity.
TEST(LinkEstimator, ASmallShooterGivesAllThatItSends) {
  const Surface shooter = sheet({0.62, 0.55}, {0.64, 0.58}, 0.15, false);
  const Sheets sheets(sheet({0, 0}, {1, 1}, 0, true), shooter, {}, Basis::constant);
  const Vec3 middle(0.63, 0.565, 0.15);
  const double sent =
      0.02 * 0.03 * point_to_polygon(middle, {0, 0, -1}, sheets.clusters[0].polygons[0].polygon);
  EXPECT_NEAR(sheets.estimate.transport[0], sent, 0.01 * sent);
}

/// A shadow that falls between all points of the receiver is an error of what it hides.
TEST(LinkEstimator, ASmallShadowBetweenThePointsIsAnError) {
  const Surface receiver = sheet({0, 0}, {1, 1}, 0, true),
                shooter = sheet({0.495, 0.495}, {0.505, 0.505}, 1, false);
  const Sheets open(receiver, shooter, {}, Basis::linear);
  // Halfway to (0.35, 0.35), where its shadow is 6 cm wide.
  const Sheets hidden(receiver, shooter, {sheet({0.41, 0.41}, {0.44, 0.44}, 0.5, true)},
                      Basis::linear);
  ASSERT_FLOAT_EQ(hidden.estimate.transport[0], open.estimate.transport[0]) << "a point is hidden";
  double lost = 0.0;  // m2: of the shadow, by the factors there
  constexpr int side = 100;
  for (int i = 0; i < side * side; ++i) {
    const Vec3 x(0.3 + 0.1 * (i / side + 0.5) / side, 0.3 + 0.1 * (i % side + 0.5) / side, 0);
    const Vec3 at = 0.5 * (x + Vec3(0.5, 0.5, 1.0));
    if (std::abs(at.x - 0.425) > 0.015 || std::abs(at.y - 0.425) > 0.015) continue;
    lost += 0.01 / (side * side) *
            point_to_polygon(x, {0, 0, 1}, hidden.clusters[1].polygons[0].polygon);
  }
  ASSERT_GT(lost, 0.0);
  EXPECT_GT(hidden.estimate.receiver_error - open.estimate.receiver_error, 0.7 * lost);
}

/// Four rays that agree prove nothing: the links that they call open or shut carry an error, and
/// not a smaller one than they have.
TEST(LinkVisibility, RaysThatAgreeAreUncertain) {
  const double edge = 0.3;  // most is seen from most parts
  const Sheets sheets(sheet({0, 0}, {1, 1}, 0, true), sheet({0, 0}, {1, 1}, 1, false),
                      {sheet({-5, -5}, {edge, 5}, 0.5, true)}, Basis::constant);
  WorkCount work;
  LinkEstimator estimator(sheets.occluders, VisibilityMethod::rays, work);
  const LinkSide shooter = LinkSide::of(sheets.shooting.patches(), ClusterId(1u), {});
  double off2 = 0.0, told2 = 0.0;
  int agreeing = 0;
  for (std::uint32_t path = 2048; path < 4096; ++path) {
    const LinkSide part = LinkSide::of(sheets.receiving.patches(), ClusterId(0u), {0, path});
    const LinkEstimate link = estimator.evaluate(part, shooter, 1e-4, nullptr);
    const double open = point_to_polygon(part.center, {0, 0, 1}, shooter.corners);
    if (link.transport[0] != 0.0f && link.transport[0] < 0.99 * open) continue;
    ++agreeing;
    const double seen = std::clamp(1.0 - (2.0 * edge - part.center.x), 0.0, 1.0);
    const double off = part.area_m2 * (link.transport[0] - open * seen);
    off2 += off * off;
    told2 += link.shooter_error * link.shooter_error;
  }
  EXPECT_EQ(work.rays, 4u * 2048u);
  EXPECT_GT(agreeing, 500);
  EXPECT_GT(told2, 0.5 * off2);
}

}  // namespace
}  // namespace enfilade
