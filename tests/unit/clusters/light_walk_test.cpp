// How often a walk of one step finds light is known: a shadow ray to the lamp, then one ray that
// may end there.
#include "clusters/light_walk.hpp"

#include <gtest/gtest.h>

#include "geometry/form_factor.hpp"
#include "unit/statistics.hpp"

namespace enfilade {
namespace {

struct LampAndBoard {
  Scene scene;
  std::vector<CellPiece> pieces;
  static constexpr double edge = 0.3;  ///< of the board, in x

  LampAndBoard() {
    const auto add = [&](const Polygon& polygon, double exitance) {
      Surface surface;
      surface.vertices = polygon;
      surface.reflectance = {0.0};
      surface.exitance = {exitance};
      CellPiece piece;
      piece.cell = CellId(0u);
      piece.piece.surface = SurfaceId(scene.surfaces.size());
      piece.piece.polygon = polygon;
      scene.surfaces.push_back(surface);
      pieces.push_back(piece);
    };
    scene.bands = 1;
    add({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, 1.0);  // faces down
    add({{edge, -5, 0.5}, {5, -5, 0.5}, {5, 5, 0.5}, {edge, 5, 0.5}}, 0.0);
  }
};

TEST(LightWalk, FindsLightAsOftenAsItIsThere) {
  const LampAndBoard with;
  LightWalk walk(with.scene, with.pieces, 1e-6, 1);
  const Vec3 up(0, 0, 1);
  Random random(1);
  const std::vector<double> places{-0.2, 0.05, 0.1, 0.3, 0.59, 0.7};
  for (const double x : places) {
    const Vec3 p(x, 0.4, 0.0);
    // The board's edge is seen at 2 edge - x on the lamp; what lies before it is open.
    const double open = std::clamp(2.0 * with.edge - x, 0.0, 1.0);
    const Polygon seen{{0, 0, 1}, {0, 1, 1}, {open, 1, 1}, {open, 0, 1}};
    const double factor = open > 0.0 ? point_to_polygon(p, up, seen) : 0.0;
    const double want = open + (1.0 - open) * factor;
    testing::Samples found;
    for (int i = 0; i < 20000; ++i) found.add(walk.finds_light(0, p, up, 1, random) ? 1.0 : 0.0);
    EXPECT_TRUE(testing::has_mean(found, want, static_cast<int>(places.size()), 1e-5)) << x;
  }
}

/// A lamp in view of the point, and a thousand out of view: among all, one draw in a thousand would
/// be the lamp; among the nearest sixteen, one in thirty-two is.
TEST(LightWalk, FindsTheLampInViewAmongAThousand) {
  LampAndBoard with;
  for (int i = 0; i < 1000; ++i) {
    Surface surface = with.scene.surfaces[0];
    for (Vec3& p : surface.vertices) p.x -= 100.0 + i, p.z -= 5.0;  // face down, below
    CellPiece piece = with.pieces[0];
    piece.piece.surface = SurfaceId(with.scene.surfaces.size());
    piece.piece.polygon = surface.vertices;
    with.pieces.push_back(piece);
    with.scene.surfaces.push_back(surface);
  }
  Random random(1);
  testing::Samples steps;
  for (int i = 0; i < 100; ++i) {
    LightWalk walk(with.scene, with.pieces, 1e-6, 1);
    EXPECT_TRUE(walk.finds_light(0, {-5.0, 0.4, 0.0}, {0, 0, 1}, 4000, random));
    steps.add(static_cast<double>(walk.steps()));
  }
  EXPECT_LT(steps.mean(), 60.0);
}

}  // namespace
}  // namespace enfilade
