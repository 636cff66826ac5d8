#include "view_factors/view_factors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/gather/box_room.hpp"
#include "view_factors/view_factor_files.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;

/// Of two parallel rectangles a x b, c apart (Howell, A Catalog of Radiation Configuration Factors,
/// C-11).
double parallel_rectangles(double a, double b, double c) {
  const double x = a / c, y = b / c, x1 = std::sqrt(1 + x * x), y1 = std::sqrt(1 + y * y);
  return 2.0 / (std::numbers::pi * x * y) *
         (std::log(x1 * y1 / std::sqrt(1 + x * x + y * y)) + x * y1 * std::atan(x / y1) +
          y * x1 * std::atan(y / x1) - x * std::atan(x) - y * std::atan(y));
}

struct Model {
  Scene scene;
  std::vector<Cluster> clusters;
  Occluders occluders;
  ViewFactorGroups groups;

  explicit Model(Scene s)
      : scene(std::move(s)), clusters(testing::clusters_of(scene)), occluders(clusters) {
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
      groups.names.push_back("s" + std::to_string(i));
      groups.of_polygon.push_back(static_cast<std::uint32_t>(i));
    }
  }
  ViewFactors factors(const ViewFactorConfig& config = {}) const {
    return view_factors(scene, clusters, occluders, groups, config);
  }
};

double at(const ViewFactors& f, std::size_t i, std::size_t j) { return f.factor[i * f.size() + j]; }

void expect_closed_and_reciprocal(const ViewFactors& f) {
  for (std::size_t i = 0; i < f.size(); ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < f.size(); ++j) {
      sum += at(f, i, j);
      EXPECT_NEAR(f.area_m2[i] * at(f, i, j), f.area_m2[j] * at(f, j, i), 1e-9);
    }
    EXPECT_NEAR(sum, 1.0, 1e-6) << i;
  }
}

TEST(ViewFactors, OfABoxAreTheAnalyticOnes) {
  const Model box(testing::box_room({0, 0, 0}, {5, 4, 3}, {0.5}, {0.0}));
  const ViewFactors f = box.factors();
  expect_closed_and_reciprocal(f);
  EXPECT_NEAR(at(f, 0, 1), parallel_rectangles(5, 4, 3), 2e-4);
  EXPECT_NEAR(at(f, 2, 3), parallel_rectangles(4, 3, 5), 2e-4);
  EXPECT_NEAR(at(f, 4, 5), parallel_rectangles(5, 3, 4), 2e-4);
  EXPECT_DOUBLE_EQ(at(f, 0, 0), 0.0);
  EXPECT_NEAR(f.sum_before[0], 1.0, 1e-6);
}

TEST(ViewFactors, OfParallelPlatesAreNotClosed) {
  Scene scene = testing::box_room({0, 0, 0}, {2, 1, 0.5}, {0.5}, {0.0});
  scene.surfaces.resize(2);
  const ViewFactors f = Model(scene).factors();
  EXPECT_NEAR(at(f, 0, 1), parallel_rectangles(2, 1, 0.5), 2e-4);
  EXPECT_NEAR(at(f, 0, 1), f.sum_before[0], 1e-3);
  EXPECT_FALSE(f.closed[0]);
}

TEST(ViewFactors, KnowWhatIsHidden) {
  // A black screen across a box, from wall to wall and floor to ceiling.
  Scene scene = testing::box_room({0, 0, 0}, {4, 2, 2}, {0.5}, {0.0});
  Surface screen = scene.surfaces[2];
  for (Vec3& v : screen.vertices) v.x = 2.0;
  scene.surfaces.push_back(screen);
  std::reverse(screen.vertices.begin(), screen.vertices.end());
  scene.surfaces.push_back(screen);
  const ViewFactors f = Model(scene).factors();
  expect_closed_and_reciprocal(f);
  EXPECT_DOUBLE_EQ(at(f, 2, 3), 0.0);
  // Each half is a cube of side 2.
  EXPECT_NEAR(at(f, 2, 7) + at(f, 2, 6), parallel_rectangles(2, 2, 2), 2e-4);
}

TEST(ViewFactors, WhatABodyCoversDoesNotCount) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 4, 3}, {0.5}, {0.0});
  testing::add_block(scene, {1, 1, 0}, {2, 2, 1}, {0.5}, {0.0});
  scene.surfaces.erase(scene.surfaces.begin() + 6);  // the block's floor
  const ViewFactors f = Model(scene).factors();
  EXPECT_NEAR(f.area_m2[0], 15.0, 0.05);
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_TRUE(f.closed[i]) << i;
  expect_closed_and_reciprocal(f);
}

TEST(ViewFactors, ByRaysAgreeWithinTheirError) {
  const Model box(testing::box_room({0, 0, 0}, {5, 4, 3}, {0.5}, {0.0}));
  const ViewFactors f = box.factors({.rays = 20000});
  expect_closed_and_reciprocal(f);
  const double error = f.error[1];
  EXPECT_GT(error, 1e-4);
  EXPECT_LT(error, 0.02);
  EXPECT_NEAR(at(f, 0, 1), parallel_rectangles(5, 4, 3), 4.0 * error);
}

TEST(ViewFactors, NamesAreThoseThatTheProgramsCanRead) {
  ViewFactors f{{"wall, north", "wall; north"},
                {1.0, 1.0},
                {0.25, 0.75, 0.75, 0.25},
                {0, 0, 0, 0},
                {1.0, 1.0},
                {true, true}};
  EXPECT_THAT(view_factors_csv(f), HasSubstr("\n\"wall, north\",wall; north,0.75,"));
  const std::string idf = view_factors_idf(f, "Zone, 1");
  EXPECT_THAT(idf, HasSubstr("ZoneProperty:UserViewFactors:BySurfaceName,\n  Zone  1,\n"));
  EXPECT_THAT(idf, HasSubstr("  wall  north,wall  north_2,0.750000000,\n"));
  EXPECT_THAT(idf, ::testing::EndsWith("wall  north_2,wall  north_2,0.250000000;\n"));
  EXPECT_THAT(view_factors_moose(f), HasSubstr("boundary = 'wall,_north wall__north'"));
  EXPECT_THAT(view_factors_moose(f), HasSubstr("view_factors = '0.25 0.75;"));
}

}  // namespace
}  // namespace enfilade
