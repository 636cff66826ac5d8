// Screens, screens of several polygons, and screens behind one another hide two plates; but a slit,
// however thin, hides nothing.
#include "visibility/occlusion.hpp"

#include <gtest/gtest.h>

#include <array>

#include "base/random.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"

namespace enfilade {
namespace {

constexpr double tolerance_m = 1e-4;

// Two plates, 1 x 1 m, that face each other over 4 m; tests put screens between them.
plan::Plan two_plates() {
  plan::Plan plan;
  plan.rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  plan.rectangle({4, 0, 0}, {0, 0, 1}, {0, 1, 0});
  return plan;
}

void screen(plan::Plan& plan, double x, double y0, double y1) {
  plan.rectangle({x, y0, -1}, {0, y1 - y0, 0}, {0, 0, 3});
}

std::vector<Cluster> one_cluster_each(const plan::Plan& plan) {
  std::vector<Cluster> clusters;
  for (const Polygon& polygon : plan.polygons) {
    Cluster cluster;
    cluster.id = ClusterId(clusters.size());
    cluster.cell = CellId(0);
    cluster.polygons = {{SurfaceId(clusters.size()), polygon}};
    cluster.bounds = bounds(polygon);
    cluster.area_m2 = area_m2(polygon);
    clusters.push_back(cluster);
  }
  return clusters;
}

Sight sight(const plan::Plan& plan, const OcclusionConfig& config = {}) {
  return Occlusion(one_cluster_each(plan), tolerance_m, config).between(0, 1, config.max_parts);
}

TEST(Occlusion, FreeSightIsOpen) { EXPECT_EQ(sight(two_plates()), Sight::open); }

TEST(Occlusion, PlatesThatShowTheirBacksAreHidden) {
  plan::Plan plan = two_plates();
  std::swap(plan.polygons[0][1], plan.polygons[0][3]);
  EXPECT_EQ(sight(plan), Sight::hidden);
}

TEST(Occlusion, ScreenOfThreePolygonsHides) {
  plan::Plan plan = two_plates();
  screen(plan, 2, -1, 0.2);
  screen(plan, 2, 0.2, 0.7);
  screen(plan, 2, 0.7, 2);
  EXPECT_EQ(sight(plan), Sight::hidden);
}

TEST(Occlusion, TurnedAndFarAwayScreenHides) {
  plan::Plan plan = two_plates();
  screen(plan, 2, -1, 0.2);
  screen(plan, 2, 0.2, 2);
  plan.transform(plan::turn_and_move(1e6));
  EXPECT_EQ(sight(plan), Sight::hidden);
}

/// Lines that come through the slit at x = 1 end on the screen; others pass above it.
TEST(Occlusion, TheLastWindowsOfAPathNarrowTheLineSpace) {
  plan::Plan plan = two_plates();
  screen(plan, 5.5, -10, 0.6);
  const auto upright = [](double x, double y0, double y1) {
    return Polygon{{x, y0, 0}, {x, y1, 0}, {x, y1, 1}, {x, y0, 1}};
  };
  const SourcePolygon source{plan.polygons[0], plane_of(plan.polygons[0]), 0};
  const std::array<const SourcePolygon*, 1> sources{&source};
  const Vec3 onwards(1, 0, 0);
  std::vector<Window> path{{upright(1, 0, 0.1), onwards}};
  for (const double x : {2.0, 3.0, 3.5}) path.push_back({upright(x, -1, 2), onwards});
  const Polygon window = upright(6, 0, 1);
  const Plane plane{onwards, 6};
  std::vector<Cluster> clusters = one_cluster_each(plan);
  clusters.erase(clusters.begin() + 1);  // the second plate
  for (const std::size_t windows : {4u, 3u, 0u}) {
    OcclusionConfig config;
    config.window_path = windows;
    config.window_parts = 64;
    const Occlusion occlusion(clusters, tolerance_m, config);
    EXPECT_EQ(occlusion.is_hidden({sources, path, window, plane}), windows == 4) << windows;
  }
}

TEST(Occlusion, GapIsFound) {
  plan::Plan plan = two_plates();
  screen(plan, 2, -1, 0.45);
  screen(plan, 2, 0.5, 2);
  EXPECT_EQ(sight(plan), Sight::open);
}

TEST(Occlusion, SlitOfATenthOfAMillimetreIsNeverHidden) {
  plan::Plan plan = two_plates();
  screen(plan, 2, -1, 0.45);
  screen(plan, 2, 0.4501, 2);
  OcclusionConfig config;
  for (config.max_parts = 1; config.max_parts <= 256; config.max_parts *= 4) {
    EXPECT_NE(sight(plan, config), Sight::hidden) << config.max_parts;
  }
}

TEST(Occlusion, GapsThatNoLineJoinsAreHidden) {
  plan::Plan plan = two_plates();
  screen(plan, 1.8, -1, 0.0);
  screen(plan, 1.8, 0.2, 2);  // open from 0.0 to 0.2
  screen(plan, 2.0, -1, 0.7);
  screen(plan, 2.0, 0.9, 2);  // open from 0.7 to 0.9: too steep a line
  EXPECT_EQ(sight(plan), Sight::hidden);
}

TEST(Occlusion, GapsThatALineJoinsAreNot) {
  plan::Plan plan = two_plates();
  screen(plan, 1.8, -1, 0.4);
  screen(plan, 1.8, 0.5, 2);
  screen(plan, 2.0, -1, 0.45);
  screen(plan, 2.0, 0.55, 2);
  EXPECT_NE(sight(plan), Sight::hidden);
}

TEST(Occlusion, PartsHiddenByDifferentScreensAreHidden) {
  plan::Plan plan = two_plates();
  // Neither screen hides all of the second plate; together, at different depths, they do.
  screen(plan, 3.0, -1, 0.55);
  screen(plan, 3.2, 0.5, 2);
  plan.rectangle({3.0, 0.55, -1}, {0.2, 0, 0}, {0, 0, 3});  // closes the way between them
  EXPECT_EQ(sight(plan), Sight::hidden);
}

// Three screens, each with a doorway: no plane alone hides more than a part.
void three_doorways(plan::Plan& plan, double first, double second, double third) {
  const auto wall = [&](double x, double y0) {
    screen(plan, x, -1, y0);
    screen(plan, x, y0 + 0.1, 2);
  };
  wall(1.0, first);
  wall(2.0, second);
  wall(3.0, third);
}

TEST(Occlusion, DoorwaysOutOfLineHide) {
  plan::Plan plan = two_plates();
  three_doorways(plan, 0.2, 0.6, 0.2);
  plan.transform(plan::turn_and_move(1e3));
  EXPECT_EQ(sight(plan), Sight::hidden);
}

TEST(Occlusion, DoorwaysInLineAreNeverHidden) {
  plan::Plan plan = two_plates();
  three_doorways(plan, 0.2, 0.25, 0.3);
  OcclusionConfig config;
  for (config.max_parts = 1; config.max_parts <= 256; config.max_parts *= 4) {
    EXPECT_NE(sight(plan, config), Sight::hidden) << config.max_parts;
  }
}

bool blocks(const Polygon& polygon, const Vec3& a, const Vec3& b) {
  const Plane plane = plane_of(polygon);
  const double da = plane.signed_distance(a), db = plane.signed_distance(b);
  if (da * db >= 0.0) return false;
  const Vec3 hit = a + da / (da - db) * (b - a);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (glm::dot(glm::cross(plane.n, edge), hit - polygon[i]) < 0.0) return false;
  }
  return true;
}

// Is a segment between the first two polygons free of all others? Many are tried.
bool has_free_segment(const plan::Plan& plan, Random& random) {
  const auto on = [&](const Polygon& p) {
    return p[0] + random.uniform() * (p[1] - p[0]) + random.uniform() * (p[3] - p[0]);
  };
  for (int k = 0; k < 4000; ++k) {
    const Vec3 a = on(plan.polygons[0]), b = on(plan.polygons[1]);
    bool free = true;
    for (std::size_t i = 2; i < plan.polygons.size() && free; ++i) {
      free = !blocks(plan.polygons[i], a, b);
    }
    if (free) return true;
  }
  return false;
}

TEST(Occlusion, RandomPlatesAreNeverHiddenWhereASegmentIsFree) {
  Random random(11);
  int hidden = 0, open = 0;
  for (int scene = 0; scene < 150; ++scene) {
    plan::Plan plan = two_plates();
    const auto edge = [&] { return Vec3(random.uniform(), random.uniform(), random.uniform()); };
    for (int i = 0; i < 14; ++i) {
      const Vec3 at(0.4 + 2.6 * random.uniform(), 1.6 * random.uniform() - 0.8,
                    1.6 * random.uniform() - 0.8);
      const Vec3 u = 1.4 * edge(), v = glm::cross(u, edge());
      if (glm::length(v) > 0.1) plan.rectangle(at, u, 1.2 / glm::length(v) * v);
    }
    OcclusionConfig config;
    config.max_parts = 60;
    const Sight found = sight(plan, config);
    const bool free = has_free_segment(plan, random);
    EXPECT_FALSE(free && found == Sight::hidden) << scene;
    hidden += found == Sight::hidden ? 1 : 0;
    open += free ? 1 : 0;
  }
  EXPECT_GT(hidden, 10);
  EXPECT_GT(open, 10);
}

TEST(Occlusion, TwinInTheSamePlaneHidesNothing) {
  plan::Plan plan = two_plates();
  plan.rectangle({0, 0, 0}, {0, 0, 1}, {0, 1, 0});  // the wall's other face
  EXPECT_EQ(sight(plan), Sight::open);
}

}  // namespace
}  // namespace enfilade
