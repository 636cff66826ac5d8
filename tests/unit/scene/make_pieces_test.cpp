#include <chrono>
#include <cmath>
#include <functional>

#include "base/random.hpp"
#include "unit/scene/test_scenes.hpp"
#include "unit/source_files.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Made {
  Scene scene;
  std::vector<Piece> pieces;
  PieceReport report;
  std::string warnings;

  double area_of(const std::string& name) const {
    double sum = 0.0;
    for (const Piece& p : pieces)
      sum += scene.surfaces[p.surface.index()].name == name ? area_m2(p.polygon) : 0.0;
    return sum;
  }
};

Made make(Scene scene) {
  Made made{std::move(scene), {}, {}, ""};
  Warnings warnings;
  made.pieces = make_pieces(made.scene, warnings, &made.report);
  made.warnings = all_warnings(warnings);
  return made;
}

Made make_file(const std::string& name) {
  Warnings ignored;
  return make(read_scene(test_data(name), ignored));
}

Polygon rectangle(double x0, double y0, double x1, double y1, double z = 0.0) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

/// Turned out of all axes, scaled and moved.
Vec3 placed(const Vec3& p, double scale, const Vec3& to) {
  const Vec3 x = glm::normalize(Vec3(0.3, 0.7, -0.2)),
             y = glm::normalize(glm::cross(Vec3(1, 2, 3), x));
  return to + scale * (p.x * x + p.y * y + p.z * glm::cross(x, y));
}

void place(Scene& scene, double scale, const Vec3& to) {
  for (Surface& s : scene.surfaces) {
    for (Vec3& v : s.vertices) v = placed(v, scale, to);
  }
}

void expect_convex(const Polygon& p) {
  const Plane plane = plane_of(p);
  ASSERT_NE(plane.n, Vec3(0.0));
  const double extent = bounds(p).diagonal();
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % p.size()], &c = p[(i + 2) % p.size()];
    EXPECT_GE(glm::dot(glm::cross(b - a, c - b), plane.n), -1e-9 * extent * extent);
    EXPECT_NEAR(plane.signed_distance(a), 0.0, 1e-4 * extent);
  }
}

TEST(MakePieces, CoplanarPictureCoversItsWall) {
  const Made made = make_file("coplanar_overlap.json");
  EXPECT_NEAR(made.report.covered_area_m2, 0.7, 1e-9);
  EXPECT_NEAR(made.area_of("x0"), 3.0 * 2.5 - 0.7, 1e-9);
  EXPECT_NEAR(total_area(made.pieces), 59.0, 1e-9);
  EXPECT_THAT(made.warnings, HasSubstr("surfaces[1] \"x0\" (0.7 m2): covered"));
  EXPECT_THAT(made.warnings, Not(HasSubstr("in all"))) << "one surface needs no sum";
}

TEST(MakePieces, LampInTheCeilingPlaneIsInFrontOfIt) {
  const Made made = make_file("lamp_on_ceiling_plane.json");
  EXPECT_NEAR(made.area_of("ceil"), 11.0, 1e-9);
  EXPECT_NEAR(made.report.covered_area_m2, 1.0, 1e-9);
  EXPECT_THAT(made.warnings, HasSubstr("\"ceil\" (1 m2)"));
}

TEST(MakePieces, EmittingSurfaceIsInFrontWhateverTheOrder) {
  for (const bool lamp_first : {true, false}) {
    Scene scene;
    scene.surfaces = {grey_surface(rectangle(0, 0, 4, 4)),
                      grey_surface(rectangle(1, 1, 2, 2), 5.0)};
    if (lamp_first) std::swap(scene.surfaces[0], scene.surfaces[1]);
    const Made made = make(scene);
    double lamp = 0.0;
    for (const Piece& p : made.pieces)
      lamp += scene.surfaces[p.surface.index()].exitance[0] > 0 ? area_m2(p.polygon) : 0;
    EXPECT_NEAR(lamp, 1.0, 1e-12);
    EXPECT_NEAR(total_area(made.pieces), 16.0, 1e-12);
  }
}

TEST(MakePieces, LaterOfTwoSurfacesWithoutExitanceIsInFront) {
  Scene scene;
  scene.surfaces = {grey_surface(rectangle(0, 0, 2, 2)), grey_surface(rectangle(1, 0, 3, 2))};
  const Made made = make(scene);
  ASSERT_EQ(made.pieces.size(), 2u);
  EXPECT_NEAR(area_m2(made.pieces[0].polygon), 2.0, 1e-12);
  EXPECT_NEAR(area_m2(made.pieces[1].polygon), 4.0, 1e-12);
}

TEST(MakePieces, OverlapsLeaveExactlyTheUnionAtAnyScaleAndPlace) {
  for (const double scale : {1e-3, 1.0, 1e4}) {
    for (const Vec3& to : {Vec3(0.0), Vec3(1e6, -2e6, 3e5)}) {
      if (scale < 1.0 && to.x > 0.0) continue;  // a scene of mm at 1e6 m has no digits left
      Random random(17);
      Scene scene;
      std::array<std::array<bool, 20>, 20> covered{};
      for (int i = 0; i < 40; ++i) {
        const auto x = random.below(16), y = random.below(16), w = 1 + random.below(4),
                   h = 1 + random.below(4);
        const auto d = [](std::uint64_t v) { return static_cast<double>(v); };
        scene.surfaces.push_back(grey_surface(rectangle(d(x), d(y), d(x + w), d(y + h)),
                                              random.below(3) == 0 ? 1.0 : 0.0));
        scene.surfaces.back().reflectance = {0.01 * static_cast<double>(i)};
        for (auto a = x; a < x + w; ++a) {
          for (auto b = y; b < y + h; ++b) covered[a][b] = true;
        }
      }
      double union_area = 0.0, input_area = 0.0;
      for (const auto& row : covered)
        union_area += static_cast<double>(std::count(row.begin(), row.end(), true));
      place(scene, scale, to);
      for (const Surface& s : scene.surfaces) input_area += area_m2(s.vertices);
      const Made made = make(scene);
      EXPECT_NEAR(total_area(made.pieces) / (scale * scale), union_area, 1e-4) << scale;
      EXPECT_NEAR((total_area(made.pieces) + made.report.covered_area_m2) / input_area, 1.0, 1e-9);
      for (const Piece& p : made.pieces) expect_convex(p.polygon);
    }
  }
}

TEST(MakePieces, DuplicateIsDroppedAndTheFirstStays) {
  const Made made = make_file("duplicate_polygon.json");
  EXPECT_EQ(made.area_of("floor_dup"), 0.0);
  EXPECT_NEAR(made.area_of("floor"), 12.0, 1e-12);
  EXPECT_EQ(made.report.dropped, 1u);
  EXPECT_THAT(made.warnings, HasSubstr("surfaces[10] \"floor_dup\" (12 m2): same outline"));
}

TEST(MakePieces, SameOutlineOfOtherMaterialIsNoDuplicate) {
  Scene scene;
  scene.surfaces = {grey_surface(rectangle(0, 0, 1, 1)), grey_surface(rectangle(0, 0, 1, 1))};
  scene.surfaces[1].reflectance = {0.2};
  const Made made = make(scene);
  ASSERT_EQ(made.pieces.size(), 1u);
  EXPECT_EQ(made.pieces[0].surface, SurfaceId(1));
}

TEST(MakePieces, SliversAndPointsAreDroppedByName) {
  const Made made = make_file("slivers.json");
  EXPECT_EQ(made.pieces.size(), 10u);
  EXPECT_EQ(made.report.dropped, 3u);
  for (const char* name : {"sliver", "zero_area", "point"})
    EXPECT_THAT(made.warnings, HasSubstr(name));
}

TEST(MakePieces, FarVerticesAndScenesOfNothingAreRefused) {
  Scene scene = make_file("slivers.json").scene;
  const auto fault = [&] { return input_error([&] { make(scene); }); };
  scene.surfaces[3].vertices[1].y = 1.1e9;
  EXPECT_THAT(fault(), HasSubstr("surfaces[3] \"" + scene.surfaces[3].name + "\".vertices"));
  for (Surface& s : scene.surfaces) s.vertices.assign(3, Vec3(1.0));
  EXPECT_THAT(fault(), HasSubstr("surfaces: none has an area"));
}

TEST(MakePieces, LiftedCornerIsSplitIntoPlanarParts) {
  const Made made = make_file("nonplanar_quad.json");
  EXPECT_EQ(made.pieces.size(), 12u);
  EXPECT_THAT(made.warnings, HasSubstr("surfaces[10] \"warped\": not planar"));
  for (const Piece& p : made.pieces) {
    const Plane plane = plane_of(p.polygon);
    for (const Vec3& v : p.polygon) EXPECT_NEAR(plane.signed_distance(v), 0.0, 1e-12);
  }
}

TEST(MakePieces, RoundedCoordinatesOfABuildingStayPlanar) {
  Scene scene;
  scene.surfaces = {grey_surface(rectangle(0, 0, 20, 10)),
                    grey_surface({{0, 0, 3}, {1, 0, 3}, {1, 1, 3.0002}, {0, 1, 3}})};
  const Made made = make(scene);
  EXPECT_EQ(made.pieces.size(), 2u);
  EXPECT_EQ(made.warnings, "");
}

TEST(MakePieces, ASpikeDoesNotMakeABentPolygonPlanar) {
  // Without its spike the polygon is 1 m wide and bent by 5 cm; with it, 1 km.
  Scene scene;
  scene.surfaces = {
      grey_surface(rectangle(0, 0, 2000, 2000)),
      grey_surface({{0, 0, 3}, {1000, 0, 3}, {0, 0, 3}, {1, 0, 3}, {1, 1, 3.1}, {0, 1, 3}})};
  const Made made = make(scene);
  ASSERT_EQ(made.pieces.size(), 3u);
  for (const Piece& p : made.pieces) {
    const Plane plane = plane_of(p.polygon);
    for (const Vec3& v : p.polygon) EXPECT_NEAR(plane.signed_distance(v), 0.0, 1e-9);
  }
}

TEST(MakePieces, BowtieIsRefusedByName) {
  const std::string fault = input_error([] { make_file("nonconvex.json"); });
  EXPECT_THAT(fault, HasSubstr("surfaces[11] \"bowtie\".vertices: the polygon crosses itself"));
}

TEST(MakePieces, UnevenBowtieIsRefusedToo) {
  Scene scene;
  scene.surfaces = {
      grey_surface({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {3, 3, 0}, {5, 1, 0}, {0, 3, 0}})};
  EXPECT_THAT(input_error([&] { make(scene); }), HasSubstr("crosses itself"));
}

void expect_split(const Polygon& outline, double area, std::size_t most,
                  const std::function<bool(const Vec3&)>& inside) {
  for (const double scale : {1e-3, 1.0, 1e4}) {
    Scene scene;
    scene.surfaces = {grey_surface(outline)};
    place(scene, scale, scale * Vec3(3, 4, 5));
    const Made made = make(scene);
    EXPECT_EQ(made.report.split, 1u);
    EXPECT_LE(made.pieces.size(), most);
    EXPECT_NEAR(total_area(made.pieces) / (scale * scale), area, 1e-6);
    for (const Piece& p : made.pieces) {
      expect_convex(p.polygon);
      EXPECT_GT(glm::dot(normal(p.polygon), normal(scene.surfaces[0].vertices)), 0.999);
    }
  }
  Scene flat;
  flat.surfaces = {grey_surface(outline)};
  for (const Piece& p : make(flat).pieces) EXPECT_TRUE(inside(centroid(p.polygon)));
}

TEST(MakePieces, LShapeBecomesTwoOrThreeConvexParts) {
  expect_split({{1, 1, 0}, {3, 1, 0}, {3, 1.5, 0}, {1.5, 1.5, 0}, {1.5, 2.5, 0}, {1, 2.5, 0}}, 1.5,
               3, [](const Vec3& c) { return c.y < 1.5 || c.x < 1.5; });
}

TEST(MakePieces, StarIsSplit) {
  Polygon star;
  for (int i = 0; i < 10; ++i) {
    const double r = i % 2 == 0 ? 2.0 : 0.8, a = 0.628318530717958647 * i;
    star.emplace_back(r * std::cos(a), r * std::sin(a), 0.0);
  }
  expect_split(star, 5.0 * 2.0 * 0.8 * std::sin(0.628318530717958647), 10,
               [](const Vec3&) { return true; });
}

TEST(MakePieces, HoleJoinedToTheOutlineByACutIsNoCrossing) {
  expect_split({{0, 0, 0},
                {4, 0, 0},
                {4, 4, 0},
                {0, 4, 0},
                {0, 0, 0},
                {1, 1, 0},
                {1, 3, 0},
                {3, 3, 0},
                {3, 1, 0},
                {1, 1, 0}},
               12.0, 8, [](const Vec3& c) { return c.x < 1 || c.x > 3 || c.y < 1 || c.y > 3; });
}

TEST(MakePieces, RepeatedVerticesGoAndCollinearOnesStay) {
  Scene scene;
  scene.surfaces = {
      grey_surface({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 0}})};
  const Made made = make(scene);
  ASSERT_EQ(made.pieces.size(), 1u);
  EXPECT_EQ(made.pieces[0].polygon.size(), 5u);
  EXPECT_EQ(made.warnings, "");
}

TEST(MakePieces, ARealGapAndAWallWithoutThicknessAreNotTouched) {
  for (const char* file : {"thin_gap.json", "zero_thickness_wall.json"}) {
    const Made made = make_file(file);
    EXPECT_EQ(made.pieces.size(), made.scene.surfaces.size()) << file;
    EXPECT_EQ(made.warnings, "") << file;
  }
  // Turned out of the axes, rounding moves the two sides of the wall through each other.
  Warnings ignored;
  Scene wall = read_scene(test_data("zero_thickness_wall.json"), ignored);
  place(wall, 1.0, Vec3(100, 200, 300));
  EXPECT_EQ(make(wall).pieces.size(), wall.surfaces.size());
}

TEST(MakePieces, SameFacingSheetsAMillimetreApartAreTwo) {
  Scene scene;
  scene.surfaces = {grey_surface(rectangle(0, 0, 3, 3)),
                    grey_surface(rectangle(1, 1, 2, 2, 0.001))};
  const Made made = make(scene);
  EXPECT_NEAR(total_area(made.pieces), 10.0, 1e-12);
  EXPECT_EQ(made.warnings, "");
}

TEST(MakePieces, ReversedWallIsNamed) {
  const Made made = make_file("reversed_normal.json");
  EXPECT_THAT(made.warnings, HasSubstr("surfaces[2] \"x1\": faces the other way"));
  EXPECT_THAT(made.warnings, Not(HasSubstr("floor")));
  EXPECT_EQ(made.pieces.size(), 10u);
}

TEST(MakePieces, TwoSidedSurfaceHasPiecesBothWays) {
  Scene scene;
  scene.surfaces = {grey_surface(rectangle(0, 0, 1, 2))};
  scene.surfaces[0].two_sided = true;
  const Made made = make(scene);
  ASSERT_EQ(made.pieces.size(), 2u);
  EXPECT_EQ(made.pieces[1].surface, SurfaceId(0));
  EXPECT_EQ(normal(made.pieces[0].polygon), -normal(made.pieces[1].polygon));
}

TEST(MakePieces, ShippedScenesAreCleanAndTheRealHouseIsBorne) {
  const std::string folder = source_file("scenes/");
  for (const char* file : {"box.json", "two_rooms.json", "furnace.json"}) {
    Warnings warnings;
    const Made made = make(read_scene(folder + file, warnings));
    EXPECT_TRUE(warnings.empty()) << all_warnings(warnings);
    EXPECT_EQ(made.warnings, "") << file;
    EXPECT_FALSE(made.scene.probes.empty());
  }
  Warnings warnings;
  const Made house = make(read_scene(folder + "duplex.json", warnings));
  double area = 0.0;
  for (const Surface& s : house.scene.surfaces) area += area_m2(s.vertices);
  EXPECT_NEAR(total_area(house.pieces) + house.report.covered_area_m2, area, 1e-6 * area);
  EXPECT_GT(house.report.covered_area_m2, 1.0);
  EXPECT_THAT(house.warnings, HasSubstr("covered area left out in all"));
}

TEST(MakePieces, SixtyThousandPolygonsInAPlaneAreFast) {
  Scene scene;
  for (int i = 0; i < 60000; ++i) {
    const double x = i % 250, y = i / 250;
    scene.surfaces.push_back(grey_surface(rectangle(x, y, x + 1, y + 1)));
  }
  scene.surfaces.push_back(grey_surface(rectangle(10.5, 10.5, 12.5, 12.5), 1.0));
  const auto start = std::chrono::steady_clock::now();
  const Made made = make(scene);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_NEAR(total_area(made.pieces), 60000.0, 1e-6);
  EXPECT_NEAR(made.report.covered_area_m2, 4.0, 1e-9);
  EXPECT_LT(took.count(), 60.0);  // 0.4 s in a release build; sanitizers take longer
}

}  // namespace
}  // namespace enfilade
