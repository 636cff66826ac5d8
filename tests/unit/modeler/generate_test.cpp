#include "modeler/generate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "base/random.hpp"
#include "geometry/sampling.hpp"
#include "raycast/ray_scene.hpp"
#include "unit/modeler/buildings.hpp"

namespace enfilade {
namespace {

using testing::preset;
using testing::small_building;

/// Every surface is planar and convex, and has a reflectance, a name and an object.
void expect_sound(const Scene& scene) {
  for (const Surface& s : scene.surfaces) {
    const Plane plane = plane_of(s.vertices);
    ASSERT_GT(area_m2(s.vertices), 1e-5) << s.object << " " << s.name;
    for (std::size_t i = 0; i < s.vertices.size(); ++i) {
      const Vec3 &a = s.vertices[i], &b = s.vertices[(i + 1) % s.vertices.size()],
                 &c = s.vertices[(i + 2) % s.vertices.size()];
      ASSERT_LT(std::abs(plane.signed_distance(a)), 1e-8) << s.object << " " << s.name;
      ASSERT_GT(glm::dot(glm::cross(b - a, c - b), plane.n), 0.0) << s.object << " " << s.name;
    }
    for (const double rho : s.reflectance) ASSERT_TRUE(rho > 0.0 && rho < 0.95) << s.object;
    ASSERT_FALSE(s.name.empty() || s.object.empty());
  }
}

/// Rays from the fronts of a closed building's surfaces: how many end on none, or on a back.
long leaks(const Scene& scene, int rays_each) {
  std::vector<Polygon> polygons;
  for (const Surface& s : scene.surfaces) polygons.push_back(s.vertices);
  const RayScene rays(polygons);
  Random random(5);
  long leaks = 0;
  for (const Polygon& polygon : polygons) {
    const Vec3 n = normal(polygon), c = centroid(polygon);
    for (int i = 0; i < rays_each; ++i) {
      // Clear of the edges: nearer to one than the offset, the start may lie behind a neighbour.
      const Vec3 corner = polygon[random.below(polygon.size())];
      const Vec3 p = c + 0.9 * random.uniform() * (corner - c) + 1e-4 * n;
      const double r2 = random.uniform(), turn = random.uniform();
      const RayHit hit = rays.closest(p, cosine_direction(n, r2, turn));
      leaks += !hit.any() || !hit.front;
    }
  }
  return leaks;
}

TEST(Generate, SurfacesArePlanarConvexAndNamed) {
  expect_sound(building_scene(small_building()));
  expect_sound(building_scene(small_building({{"rotate", "33"}, {"windows", "none"}})));
  expect_sound(building_scene(preset("demo")));
}

TEST(Generate, NoSurfaceIsSplitDroppedCoveredOrSuspectedToFaceTheWrongWay) {
  for (const Building& building : {small_building(), small_building({{"furnace", "100"}}),
                                   small_building({{"rotate", "21"}}), preset("demo")}) {
    const Scene scene = building_scene(building);
    Warnings warnings;
    PieceReport report;
    EXPECT_EQ(make_pieces(scene, warnings, &report).size(), scene.surfaces.size());
    EXPECT_TRUE(warnings.empty()) << warnings.summary().front();
    EXPECT_EQ(report.covered_area_m2, 0.0);
  }
}

TEST(Generate, AFurnaceIsClosedAndNothingShowsItsBack) {
  for (const char* windows : {"closed", "none"}) {
    for (const char* rotate : {"0", "27"}) {
      const Building furnace =
          small_building({{"furnace", "100"}, {"windows", windows}, {"rotate", rotate}});
      EXPECT_EQ(leaks(building_scene(furnace), 40), 0) << windows << " " << rotate;
    }
  }
}

TEST(Generate, AnOpenWindowLeaks) { EXPECT_GT(leaks(building_scene(small_building()), 10), 100); }

TEST(Generate, EverySurfaceOfAFurnaceSendsOutWhatItDoesNotReflect) {
  const Building building = small_building({{"furnace", "250"}, {"colours", "true"}});
  std::size_t count = 0;
  const GeneratedCounts counts = generate_building(building, [&](const Surface& s) {
    ASSERT_EQ(s.exitance.size(), 3u);
    for (std::size_t b = 0; b < 3; ++b) {
      EXPECT_DOUBLE_EQ(s.exitance[b] + 250.0 * s.reflectance[b], 250.0);
    }
    ++count;
  });
  EXPECT_EQ(counts.surfaces, count);
  EXPECT_EQ(counts.lights, count);
}

TEST(Generate, RotationTurnsTheSameBuilding) {
  const Scene still = building_scene(small_building()),
              turned = building_scene(small_building({{"rotate", "40"}}));
  const double angle = 40.0 * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
  ASSERT_EQ(still.surfaces.size(), turned.surfaces.size());
  for (std::size_t i = 0; i < still.surfaces.size(); ++i) {
    const Surface &a = still.surfaces[i], &b = turned.surfaces[i];
    ASSERT_EQ(a.object, b.object);
    ASSERT_EQ(a.exitance, b.exitance);
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    for (std::size_t k = 0; k < a.vertices.size(); ++k) {
      const Vec3& p = a.vertices[k];
      ASSERT_LT(glm::length(Vec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z) - b.vertices[k]), 5e-9);
    }
  }
}

TEST(Generate, TheSameSeedGivesTheSameBuildingAndAnotherSeedAnother) {
  const Scene a = building_scene(small_building()), b = building_scene(small_building()),
              c = building_scene(small_building({{"seed", "2"}}));
  ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
  EXPECT_EQ(a.surfaces.size(), c.surfaces.size());
  bool differs = false;
  for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
    EXPECT_EQ(a.surfaces[i].vertices, b.surfaces[i].vertices);
    differs |= a.surfaces[i].vertices != c.surfaces[i].vertices;
  }
  EXPECT_TRUE(differs);
}

TEST(Generate, StoreysAddTheSameNumberEach) {
  const auto surfaces = [](const char* floors) {
    return building_scene(small_building({{"floors", floors}})).surfaces.size();
  };
  const std::size_t three = surfaces("3"), four = surfaces("4"), five = surfaces("5");
  EXPECT_EQ(four - three, five - four);
  EXPECT_GT(four - three, 500u);
}

TEST(Generate, ObjectsAreFew) {
  // An object is a chair or a wall; its parts follow each other in the file.
  const Scene scene = building_scene(preset("demo"));
  EXPECT_LT(scene.surfaces.size(), 3000u);
  std::set<std::string> done;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    if (i > 0 && scene.surfaces[i].object == scene.surfaces[i - 1].object) continue;
    EXPECT_TRUE(done.insert(scene.surfaces[i].object).second) << scene.surfaces[i].object;
  }
}

}  // namespace
}  // namespace enfilade
