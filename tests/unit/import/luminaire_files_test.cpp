// Lamps of a model and photometric files, by name.
#include "import/luminaire_files.hpp"

#include <numbers>

#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;

using std::numbers::pi;

std::string ies(double candela) {
  return "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 20\n0 45 90\n0\n" +
         std::to_string(candela) + " 0 0\n";
}
double flux_of(const LightSource& light) { return 4.0 * pi * light.intensity.at(0); }

Scene building() {
  Scene scene;
  scene.bands = 3;
  scene.unit = ExitanceUnit::lumen_per_m2;
  scene.building.luminaires = {{"lamp 1", "Down-Light 600:LED 20W", {1, 1, 2}, 800.0},
                               {"lamp 2", "DOWN LIGHT 600", {2, 1, 2}, 0.0},
                               {"lamp 3", "Unknown", {3, 1, 2}, 500.0},
                               {"lamp 4", "Family:Panel", {4, 1, 2}, 0.0}};
  scene.building.luminaires[0].light = 0;
  scene.building.luminaires[2].light = 1;
  scene.lights.push_back({{1, 1, 2}, Spectrum(3, 800.0 / (4 * pi))});
  scene.lights.push_back({{3, 1, 2}, Spectrum(3, 500.0 / (4 * pi))});
  return scene;
}

TEST(LuminaireFiles, AFileThatTheModelNamesComesBeforeTheTypeAndTakesTheLampsWholeFlux) {
  const TemporaryFolder folder;
  folder.write("Unknown.ies", ies(100));
  folder.write("Panel 600.ies", ies(200));
  Scene scene = building();
  scene.building.luminaires[2].file = "Panel 600";
  scene.building.luminaires[0].file = "not there";
  // Of the lamp's 500 lm the model's own distribution lets 400 out.
  scene.lights[1].distribution =
      std::make_shared<const IntensityDistribution>(spot_distribution(0.1, 0.2));
  scene.lights[1].intensity = Spectrum(3, 400.0 / (4 * pi));
  Warnings warnings;
  match_luminaires(scene, folder.file(""), warnings);
  ASSERT_TRUE(scene.lights[1].distribution);
  EXPECT_GT(scene.lights[1].distribution->intensity(Vec3(0, 0, 1)), 150.0);
  EXPECT_NEAR(flux_of(scene.lights[1]), 500.0, 1e-9);
  EXPECT_THAT(all_warnings(warnings), HasSubstr("lamp type \"not there\" (1 of them)"));
}

TEST(LuminaireFiles, AreFoundByTypeWhateverCaseAndSigns) {
  const TemporaryFolder folder;
  folder.write("downlight_600.ies", ies(100));
  folder.write("PANEL.IES", ies(200));
  Scene scene = building();
  Warnings warnings;
  warnings.add("lamp \"lamp 2\"", "tells no luminous flux: it stays dark");
  warnings.add("lamp \"other\"", "tells no luminous flux: it stays dark");
  const LuminaireMatches matches = match_luminaires(scene, folder.file(""), warnings);
  EXPECT_EQ(matches.files, 2u);
  EXPECT_EQ(matches.lamps, 4u);
  EXPECT_EQ(matches.matched, 3u);
  ASSERT_EQ(scene.lights.size(), 4u);
  ASSERT_TRUE(scene.lights[0].distribution);
  EXPECT_NEAR(flux_of(scene.lights[0]), 800.0, 1e-9);  // the model's flux scales the file's
  EXPECT_FALSE(scene.lights[1].distribution);
  EXPECT_NEAR(flux_of(scene.lights[1]), 500.0, 1e-9);
  EXPECT_NEAR(flux_of(scene.lights[2]), scene.lights[2].distribution->flux(), 1e-9);
  EXPECT_EQ(scene.lights[2].distribution, scene.lights[0].distribution);
  EXPECT_NEAR(flux_of(scene.lights[3]), 2.0 * flux_of(scene.lights[2]), 1e-9);
  EXPECT_EQ(scene.lights[3].p, Vec3(4, 1, 2));
  const std::string told = all_warnings(warnings);
  EXPECT_THAT(told, HasSubstr("lamp type \"Unknown\" (1 of them): has no photometric file in"));
  EXPECT_THAT(told, testing::Not(HasSubstr("lamp 2")));
  EXPECT_THAT(told, HasSubstr("lamp \"other\""));
}

TEST(LuminaireFiles, NamedLightsGetThemToo) {
  const TemporaryFolder folder;
  folder.write("bulb.ies", ies(100));
  Scene scene;
  scene.bands = 1;
  scene.lights.push_back({{0, 0, 1}, {5.0}});
  scene.lights.push_back({{0, 0, 1}, {7.0}});
  scene.lights[0].name = "Bulb";
  Warnings warnings;
  EXPECT_EQ(match_luminaires(scene, folder.file(""), warnings).matched, 1u);
  EXPECT_TRUE(scene.lights[0].distribution);
  EXPECT_EQ(scene.lights[0].intensity[0], 5.0);
  EXPECT_FALSE(scene.lights[1].distribution);
}

TEST(LuminaireFiles, FaultyFoldersAndFilesAreRefused) {
  const TemporaryFolder folder;
  Warnings warnings;
  Scene scene = building();
  EXPECT_THAT(input_error([&] { match_luminaires(scene, folder.file("none"), warnings); }),
              HasSubstr("is no folder"));
  EXPECT_THAT(input_error([&] { match_luminaires(scene, folder.file(""), warnings); }),
              HasSubstr("holds no photometric file"));
  folder.write("panel.ldt", "no luminaire");
  EXPECT_THAT(input_error([&] { match_luminaires(scene, folder.file(""), warnings); }),
              HasSubstr("panel.ldt"));
}

}  // namespace
}  // namespace enfilade
