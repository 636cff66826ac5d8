#include "import/radiance/radiance_import.hpp"

#include <numbers>

#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using std::numbers::pi;
const std::string grey = "void plastic grey 0 0 5 .5 .5 .5 0 0\n";
const std::string triangle = " polygon tri 0 0 9 0 0 0 1 0 0 0 1 0\n";

struct Imported {
  Scene scene;
  std::string warnings;
};

Imported import_text(const std::string& text) {
  const TemporaryFolder folder;
  Warnings warnings;
  Scene scene = import_radiance({folder.write("room.rad", text)}, {}, warnings);
  return {std::move(scene), all_warnings(warnings)};
}

TEST(RadianceImport, ReflectorsAreTwoSidedAndLightsShineFromTheFront) {
  const auto [scene, warnings] =
      import_text("# a comment\n" + grey +
                  "void light lamp # another\n0\n0\n3 1 2 3\n\nvoid illum pane 1 grey 0 3 2 2 2\n"
                  "grey" +
                  triangle + "lamp" + triangle + "pane" + triangle);
  EXPECT_EQ(scene.bands, 3);
  EXPECT_EQ(scene.unit, ExitanceUnit::watt_per_m2);
  EXPECT_EQ(warnings, "");
  ASSERT_EQ(scene.surfaces.size(), 4u);
  const Surface& reflector = scene.surfaces[0];
  EXPECT_TRUE(reflector.two_sided);
  EXPECT_EQ(reflector.reflectance, Spectrum(3, 0.5));
  EXPECT_EQ(reflector.exitance, Spectrum(3, 0.0));
  const Surface& lamp = scene.surfaces[1];
  EXPECT_FALSE(lamp.two_sided);
  EXPECT_EQ(lamp.reflectance, Spectrum(3, 0.0));
  EXPECT_EQ(lamp.exitance, (Spectrum{pi, 2 * pi, 3 * pi}));
  EXPECT_EQ(normal(lamp.vertices), Vec3(0, 0, 1));
  // An illum that looks like grey reflects on both sides, yet its back gives no light.
  const Surface &front = scene.surfaces[2], &back = scene.surfaces[3];
  EXPECT_FALSE(front.two_sided || back.two_sided);
  EXPECT_EQ(front.reflectance, back.reflectance);
  EXPECT_EQ(front.exitance, Spectrum(3, 2 * pi));
  EXPECT_EQ(back.exitance, Spectrum(3, 0.0));
  EXPECT_EQ(normal(back.vertices), Vec3(0, 0, -1));
}

TEST(RadianceImport, AHoleIsNoPartOfAnyPiece) {
  const Imported imported =
      import_text(grey +
                  "grey polygon wall 0 0 30  0 0 0  4 0 0  4 4 0  0 4 0  0 0 0\n"
                  "1 1 0  1 3 0  3 3 0  3 1 0  1 1 0\n");
  Warnings warnings;
  const std::vector<Piece> pieces = make_pieces(imported.scene, warnings);
  EXPECT_NEAR(total_area(pieces), 2.0 * (16.0 - 4.0), 1e-9);  // two sides
  for (const Piece& piece : pieces)
    EXPECT_GT(glm::length(centroid(piece.polygon) - Vec3(2, 2, 0)), 1.0);
}

TEST(RadianceImport, AliasesAndRedefinitions) {
  const auto [scene, warnings] =
      import_text(grey +
                  "void colorpict tiles 5 clip_r clip_g clip_b tiles.hdr . 0 0\n"
                  "tiles alias tiled grey\ninherit alias plain grey\ninherit alias again tiled\n"
                  "void plastic grey 0 0 5 .2 .2 .2 0 0\ntiles alias late grey\n"
                  "plain" +
                  triangle + "grey" + triangle + "late" + triangle);
  ASSERT_EQ(scene.surfaces.size(), 3u);
  EXPECT_EQ(scene.surfaces[0].reflectance[0], 0.5);
  EXPECT_EQ(scene.surfaces[1].reflectance[0], 0.2);
  EXPECT_EQ(scene.surfaces[2].reflectance[0], 0.2);
  EXPECT_THAT(warnings, HasSubstr("\"late\": pattern or texture left out"));
  EXPECT_THAT(warnings, Not(HasSubstr("tiled")));  // not in use
  EXPECT_THAT(import_text(grey +
                          "void brightfunc p 2 b b.cal 0 0\ninherit alias x grey\n"
                          "p alias y x\ninherit alias z y\nz" +
                          triangle)
                  .warnings,
              HasSubstr("\"z\": pattern"));
}

TEST(RadianceImport, ATextureMayStandBetweenShapeAndMaterial) {
  const auto [scene, warnings] =
      import_text(grey + "grey texfunc bumps 4 x y z b.cal 0 1 .1\nbumps" + triangle);
  EXPECT_EQ(scene.surfaces.at(0).reflectance[0], 0.5);
  EXPECT_THAT(warnings, HasSubstr("\"grey\": pattern or texture left out"));
}

TEST(RadianceImport, WarningsNameWhatIsLost) {
  const auto [scene, warnings] =
      import_text(grey +
                  "void mirror pane 0 0 3 .9 .9 .9\nvoid mirror unused 0 0 3 .9 .9 .9\n"
                  "pane" +
                  triangle + "pane" + triangle +
                  "void polygon ghost 0 0 9 0 0 0 1 0 0 0 1 0\n"
                  "grey source sky 0 0 4 0 0 1 180\nvoid mesh chair 1 'a b.rtm' 0 0\n");
  EXPECT_EQ(scene.surfaces.size(), 2u);
  EXPECT_EQ(warnings,
            "\"pane\": mirror: taken as black and opaque (reflectance 0)\n"
            "\"ghost\": no material (void): left out, light passes\n"
            "source \"sky\", mesh \"chair\": left out, as a scene can't hold it (2 in all)\n");
}

TEST(RadianceImport, XformTakesInFilesRelativeToTheOneThatNamesThem) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("parts"));
  folder.write("parts/leg.rad", "grey polygon leg 0 0 9 0 0 0 1 0 0 0 1 0\n");
  folder.write("parts/desk.rad", "!xform -n left -t 1 0 0 leg.rad\n!xform -mx leg.rad\n");
  const std::string path = folder.write(
      "room.rad",
      grey + "!xform -n desk -rz 90 \\\n  -t 0 0 5 parts/desk.rad\n!xform parts/leg.rad");
  Warnings warnings;
  const Scene scene = import_radiance({path}, {}, warnings);
  ASSERT_EQ(scene.surfaces.size(), 3u);
  const Surface& leg = scene.surfaces[0];
  EXPECT_EQ(leg.name, "desk.left.leg");
  EXPECT_EQ(leg.object, "desk.left");
  EXPECT_LT(glm::length(leg.vertices[0] - Vec3(0, 1, 5)),
            1e-12);  // moved, then turned, then lifted
  EXPECT_LT(glm::length(leg.vertices[1] - Vec3(0, 2, 5)), 1e-12);
  EXPECT_EQ(scene.surfaces[1].name, "desk.leg");
  EXPECT_GT(normal(scene.surfaces[1].vertices).z, 0.999);
  EXPECT_EQ(scene.surfaces[2].object, "leg");
  folder.write("parts/leg.rad", "grey polygon leg 0 0 9 0 0 0 1 0 0 0 2 0\n");
  EXPECT_NE(import_radiance({path}, {}, warnings).hash,
            scene.hash);  // what is taken in counts as well
}

TEST(RadianceImport, CyclesAndDepthEnd) {
  const TemporaryFolder folder;
  Warnings warnings;
  folder.write("b.rad", "\n!xform ./a.rad\n");
  const std::string a = folder.write("a.rad", "!xform b.rad\n");
  EXPECT_THAT(input_error([&] { import_radiance({a}, {}, warnings); }),
              HasSubstr("b.rad: line 2: \"./a.rad\" takes in itself; break the cycle"));
  for (int i = 0; i < 40; ++i) {
    folder.write("d" + std::to_string(i) + ".rad", "!xform d" + std::to_string(i + 1) + ".rad\n");
  }
  EXPECT_THAT(input_error([&] { import_radiance({folder.file("d0.rad")}, {}, warnings); }),
              HasSubstr("d31.rad: line 1: files take in others more than 32 deep"));
}

TEST(RadianceImport, FaultsNameTheirLine) {
  const auto fault = [](const std::string& text) {
    return input_error([&] { import_text(text); });
  };
  EXPECT_THAT(
      fault(grey + "\n!gensurf grey b 1 1 1\n"),
      HasSubstr("room.rad: line 3: the command \"!gensurf grey b 1 1 1\" is not carried out"));
  EXPECT_THAT(fault(grey + "!xform gone.rad"), HasSubstr("line 2: \"gone.rad\" does not exist"));
  EXPECT_THAT(fault(grey + "pink" + triangle),
              HasSubstr("line 2: polygon \"tri\" names \"pink\", which is not defined; define"));
  EXPECT_THAT(fault("pink plastic p 0 0 5 1 1 1 0 0"), HasSubstr("\"pink\", which is not defined"));
  EXPECT_THAT(fault("void alias a b"), HasSubstr("line 1: alias \"a\" names \"b\""));
  EXPECT_THAT(fault("void alias a void"), HasSubstr("stands for void"));
  EXPECT_THAT(fault("inherit plastic p 0 0 5 1 1 1 0 0"), HasSubstr("\"inherit\", which is not"));
  EXPECT_THAT(fault(grey + "grey\npoligon p 0 0 0"), HasSubstr("\"poligon\" is no type"));
  EXPECT_THAT(fault(grey + "grey sphere s\n0\n0\n4 0 0\n0x 1\n"),
              HasSubstr("line 6: \"0x\" stands"));
  EXPECT_THAT(fault(grey + "grey sphere s 0 0 nan"),
              HasSubstr("number of numbers of sphere \"s\""));
  EXPECT_THAT(fault(grey + "grey sphere s 0 0 4 0 0 nan 1"), HasSubstr("finite number"));
  EXPECT_THAT(fault(grey + "grey sphere s 0 -1 4"), HasSubstr("\"-1\" stands where"));
  EXPECT_THAT(fault(grey + "grey sphere s 0 0 99999999999 1 2"), HasSubstr("the file ends before"));
  EXPECT_THAT(fault(grey + "grey sphere 's 0 0 4\n0 0 0 1\n"), HasSubstr("line 2: a quotation"));
  EXPECT_THAT(fault(grey), HasSubstr("room.rad: file: holds no polygons"));
  EXPECT_THAT(fault(""), HasSubstr("is empty"));
}

double area_of(const Scene& scene) {
  double area = 0.0;
  for (const Surface& surface : scene.surfaces) area += area_m2(surface.vertices);
  return area;
}

TEST(RadianceImport, GeneratorsArraysAndPipes) {
  const auto [scene, warnings] =
      import_text(grey +
                  "!genbox grey desk 2 1 .5 | xform -n left -rz 90 -a 3 -t 0 2 0 -a 2 -t 5 0 0\n"
                  "!genprism grey wedge 3 0 0 1 0 0 1 -l 0 0 2\n!gensky 3 21 12\n");
  ASSERT_EQ(scene.surfaces.size(), 3u * 2u * 6u + 5u);
  EXPECT_NEAR(area_of(scene), 6.0 * 7.0 + 1.0 + 2.0 * (2.0 + std::sqrt(2.0)), 1e-9);
  EXPECT_EQ(scene.surfaces[0].object, "left");
  EXPECT_EQ(scene.surfaces[0].name, "left.desk");
  Box box;
  for (std::size_t i = 0; i < 36; ++i) box.add(bounds(scene.surfaces[i].vertices));
  EXPECT_LT(glm::length(box.lo - Vec3(-1, 0, 0)), 1e-12);
  EXPECT_LT(glm::length(box.hi - Vec3(5, 6, 0.5)), 1e-12);
  EXPECT_THAT(warnings, HasSubstr("!gensky: left out"));
}

TEST(RadianceImport, SeveralFilesAreOneModelInTheUnitThatIsAskedFor) {
  const TemporaryFolder folder;
  const std::string materials = folder.write("materials.rad", grey);
  const std::string room = folder.write("room.rad", "grey" + triangle);
  Warnings warnings;
  ImportOptions options;
  options.units = "mm";
  const Scene scene = import_radiance({materials, room}, options, warnings);
  EXPECT_NEAR(area_of(scene), 0.5e-6, 1e-15);
}

TEST(RadianceImport, MixturesAndGlass) {
  const auto [scene, warnings] = import_text(
      grey +
      "void plastic white 0 0 5 .9 .9 .9 0 0\nvoid mixfunc blend 4 grey white .25 . 0 0\n"
      "void mixfunc sieve 4 grey void .3 . 0 0\nvoid glass clear 0 0 3 .96 .96 .96\n"
      "void glass dark 0 0 3 .3 .3 .3\nblend" +
      triangle + "sieve" + triangle + "clear" + triangle + "dark" + triangle);
  ASSERT_EQ(scene.surfaces.size(), 3u);
  EXPECT_NEAR(scene.surfaces[0].reflectance[0], 0.25 * 0.5 + 0.75 * 0.9, 1e-12);
  EXPECT_NEAR(scene.surfaces[1].transmittance.at(0), 0.88, 2e-3);
  EXPECT_NEAR(scene.surfaces[2].transmittance.at(0), 0.275, 1e-3);
  EXPECT_THAT(warnings, HasSubstr("\"sieve\": mixfunc: more than half open: left out"));
}

// A cosine of 2 W/sr on the axis, in steps of 9 degrees, sends out 2 pi W; over both halves of a
// sphere, an intensity of 3 W/sr sends out 12 pi W.
TEST(RadianceImport, DistributionsKeepTheirFlux) {
  const TemporaryFolder folder;
  std::string data = "1\n0 90 11\n";
  for (int i = 0; i <= 10; ++i) data += std::to_string(2.0 * std::cos(0.05 * i * pi)) + "\n";
  folder.write("flat.dat", data);
  folder.write("all.dat", "2\n0 90 3\n0 180 2\n3 3\n3 3\n3 3\n");
  const std::string path =
      folder.write("lamps.rad",
                   "void brightdata f 4 flatcorr flat.dat source.cal src_theta 0 1 2\n"
                   "f light down 0 0 3 1 2 1\ndown polygon panel 0 0 12 0 0 3 0 1 3 .5 1 3 .5 0 3\n"
                   "void brightdata b 5 boxcorr all.dat source.cal src_phi4 src_theta 0 4 1 1 2 3\n"
                   "b light box 0 0 3 1 1 1\n!genbox box lamp 1 2 3\n");
  Warnings warnings;
  const Scene scene = import_radiance({path}, {}, warnings);
  ASSERT_EQ(scene.surfaces.size(), 7u);
  EXPECT_NEAR(scene.surfaces[0].exitance[0] * 0.5, 2.0 * pi, 0.02);
  EXPECT_NEAR(scene.surfaces[0].exitance[1] * 0.5, 4.0 * pi, 0.04);
  double of_box = 0.0;
  for (std::size_t i = 1; i < 7; ++i) {
    const Surface& face = scene.surfaces[i];
    ASSERT_TRUE(face.distribution);
    of_box += face.exitance[0] * area_m2(face.vertices);
    // Towards a corner all three faces there give by their share of the area that is shown.
    const Vec3 w(0.6, 0.64, 0.48);
    const Vec3 n = normal(face.vertices);
    const LightFrame frame = LightFrame::of(n, face.up).value();
    const double per_flux =
        face.distribution->intensity(frame.to_local(w)) / face.distribution->flux();
    const double shown = 6.0 * 0.6 + 3.0 * 0.64 + 2.0 * 0.48;
    const double expected = 3.0 * area_m2(face.vertices) * std::max(0.0, glm::dot(n, w)) / shown;
    EXPECT_NEAR(per_flux * face.exitance[0] * area_m2(face.vertices), expected, 0.01);
  }
  EXPECT_NEAR(of_box, 12.0 * pi, 0.01 * 12.0 * pi);
  EXPECT_TRUE(warnings.empty()) << all_warnings(warnings);
}

TEST(RadianceImport, DistributionsTurnWithTheirSource) {
  // A panel that faces x, its data brightest at 0 degrees, as ies2rad writes one, turned by xform.
  const TemporaryFolder folder;
  folder.write("d.dat",
               "2\n0 360 5\n0 90 3\n"
               "4 2 0\n4 1 0\n4 0 0\n4 1 0\n4 2 0\n");
  folder.write("lamp.rad",
               "void brightdata f 5 flatcorr d.dat source.cal src_phi src_theta 0 1 1\n"
               "f light down 0 0 3 1 1 1\ndown polygon panel 0 0 12 0 0 0 0 1 0 1 1 0 1 0 0\n");
  const std::string path = folder.write("all.rad", "!xform -ry -90 -t 1 2 3 lamp.rad\n");
  Warnings warnings;
  const Scene scene = import_radiance({path}, {}, warnings);
  ASSERT_EQ(scene.surfaces.size(), 1u);
  const Surface& panel = scene.surfaces[0];
  const Vec3 n = normal(panel.vertices);
  EXPECT_NEAR(n.x, 1.0, 1e-9);
  ASSERT_TRUE(panel.distribution);
  const LightFrame frame = LightFrame::of(n, panel.up).value();
  // The half-plane C = 0, which was +x, is +z now.
  const auto toward = [&](const Vec3& w) {
    return panel.distribution->intensity(frame.to_local(glm::normalize(w)));
  };
  EXPECT_NEAR(toward({1, 0, 0}), 4.0, 1e-9);
  EXPECT_NEAR(toward({1, 0, 1}), 2.0, 1e-9);
  EXPECT_NEAR(toward({1, 0, -1}), 0.0, 1e-9);
  EXPECT_NEAR(toward({1, 1, 0}), 1.0, 1e-9);
}

TEST(RadianceImport, BallOfIes2radIsALight) {
  const TemporaryFolder folder;
  folder.write("d.dat", "1\n0 180 3\n6 6 6\n");
  const std::string path = folder.write(
      "lamp.rad",
      "void brightdata f 4 corr d.dat source.cal src_theta 0 1 10\n"
      "f light all 0 0 3 1 1 1\nall sphere lamp 0 0 4 1 2 3 .001\n"
      "void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey polygon wall 0 0 9 0 0 0 9 0 0 0 9 0\n");
  Warnings warnings;
  const Scene scene = import_radiance({path}, {}, warnings);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.surfaces.size(), 1u);
  // A radiance of 60 over the ball's shadow of pi r^2.
  EXPECT_NEAR(scene.lights[0].intensity[0], 60.0 * pi * 1e-6, 1e-3 * 60.0 * pi * 1e-6);
  EXPECT_EQ(scene.lights[0].p, Vec3(1, 2, 3));
}

TEST(RadianceImport, WhatRepeatsWithoutEndIsRefused) {
  const TemporaryFolder folder;
  for (int i = 0; i < 25; ++i) {
    const std::string next = "b" + std::to_string(i + 1) + ".rad\n";
    folder.write("b" + std::to_string(i) + ".rad", "!xform -t 1 0 0 " + next + "!xform " + next);
  }
  folder.write("b25.rad", grey + "grey" + triangle);
  Warnings warnings;
  EXPECT_THAT(input_error([&] { import_radiance({folder.file("b0.rad")}, {}, warnings); }),
              HasSubstr("taken in more than 100000 times"));
  EXPECT_THAT(input_error([&] { import_text("!xform -t 1 0 0 /dev/zero\n"); }),
              HasSubstr("line 1: \"/dev/zero\" lies outside the model's folder"));
}

}  // namespace
}  // namespace enfilade
