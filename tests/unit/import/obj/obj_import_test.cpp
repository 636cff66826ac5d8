#include "import/obj/obj_import.hpp"

#include <numbers>

#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;

using std::numbers::pi;
const std::string corners = "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 1.5 3 0\nv 0 1 0\n";

struct Imported {
  Scene scene;
  std::string warnings;
};

Imported import_text(const std::string& text, const std::string& library = "",
                     const ImportOptions& options = {}) {
  const TemporaryFolder folder;
  if (!library.empty()) folder.write("m.mtl", library);
  Warnings warnings;
  Scene scene = import_obj(folder.write("m.obj", text), options, warnings);
  return {std::move(scene), all_warnings(warnings)};
}

TEST(ObjImport, KeepsPolygonsAndReadsItsMaterials) {
  const auto [scene, warnings] =
      import_text("mtllib m.mtl\n" + corners +
                      "o first\nusemtl wall\nf 1 2 3 4 5\no second\nusemtl lamp\nf 1 2 3\no third\n"
                      "usemtl pane\nf 3 4 5\n",
                  "newmtl wall\nKd 0.2 0.4 0.6\nnewmtl lamp\nKd 0 0 0\nKe 1 2 3\nnewmtl pane\nKd 1 "
                  "1 1\nd 0.1\n");
  ASSERT_EQ(scene.surfaces.size(), 2u);
  EXPECT_EQ(scene.surfaces[0].vertices.size(), 5u);
  EXPECT_NEAR(normal(scene.surfaces[0].vertices).y, -1.0, 1e-6);
  EXPECT_NEAR(scene.surfaces[0].reflectance[1], 0.4, 1e-6);
  EXPECT_EQ(scene.surfaces[0].object, "first");
  EXPECT_NEAR(scene.surfaces[1].exitance[1], 2.0 * pi, 1e-5);
  EXPECT_THAT(warnings, HasSubstr("\"third\": transparent: left out"));
}

TEST(ObjImport, WhatWritersOfTextDo) {
  // A byte order mark, blanks in front, comments within lines, a name with a blank, joined lines,
  // numbers without a leading digit or with a sign, negative numbers of points, and a comment that
  // ends as a joined line does.
  const auto [scene, warnings] = import_text(
      "\xEF\xBB\xBF  mtllib m.mtl # the library\r\n# from C:\\dir\\\r\n\tv .0 -.0 +0\r\nv 2. 0 "
      "0\r\nv \\\n2 1 0\r\n"
      "usemtl old wall # in use\r\nf -3 -2// -1/1/1\r\n",
      "\xEF\xBB\xBFnewmtl old wall\r\nKd .25 .25 .25 # grey\r\n");
  ASSERT_EQ(scene.surfaces.size(), 1u);
  EXPECT_NEAR(area_m2(scene.surfaces[0].vertices), 1.0, 1e-12);
  EXPECT_EQ(scene.surfaces[0].reflectance[0], 0.25);
  EXPECT_EQ(warnings, "");
}

TEST(ObjImport, NamesOfFilesAsOtherSystemsWriteThem) {
  for (const char* name : {"\"M.mtl\"", "M.MTL", ".\\m.mtl", "\"m.mtl\" ", "m.mtl \"m.mtl\""}) {
    const auto [scene, warnings] = import_text(
        "mtllib " + std::string(name) + "\r" + "v 0 0 0\rv 1 0 0\rv 0 1 0\rusemtl a\rf 1 2 3\r",
        "newmtl a\rKd .25 .25 .25\r");
    ASSERT_EQ(scene.surfaces.size(), 1u) << name;
    EXPECT_EQ(scene.surfaces[0].reflectance[0], 0.25) << name;
    EXPECT_EQ(warnings, "") << name;
  }
}

TEST(ObjImport, WhatIsMissingIsTold) {
  const auto [scene, warnings] = import_text(
      "mtllib nowhere.mtl\nmtllib m.mtl\n" + corners + "f 1 2 3\nusemtl wal\nf 3 4 5\n",
      "newmtl wall\nKa .5 .5 .5\nmap_Kd gone.png\nnewmtl old lamp\nKd 1 1 1\nKa 9 9 9\n");
  EXPECT_EQ(scene.surfaces.size(), 2u);
  EXPECT_EQ(scene.surfaces[1].reflectance[0], 0.5);
  EXPECT_THAT(warnings, HasSubstr("mtllib \"nowhere.mtl\": does not exist"));
  EXPECT_THAT(warnings, HasSubstr("material \"wal\": is not defined"));
  EXPECT_THAT(warnings, HasSubstr("faces before any usemtl: have no material"));
  EXPECT_THAT(warnings, HasSubstr("material \"wall\": texture \"gone.png\" does not exist"));
  EXPECT_THAT(warnings, HasSubstr("material \"wall\": has no Kd"));
  EXPECT_THAT(warnings, HasSubstr("material \"old lamp\": Ka above 1 is no light"));
}

TEST(ObjImport, UnitsAxisAndScale) {
  ImportOptions options;
  options.units = "mm";
  options.up = "z";
  options.scale = 2.0;
  const Scene scene = import_text(corners + "f 1 2 3 4 5\n", "", options).scene;
  const Box box = bounds(scene.surfaces[0].vertices);
  EXPECT_LT(glm::length(box.hi - Vec3(0.006, 0.006, 0.0)), 1e-12);
  EXPECT_NEAR(normal(scene.surfaces[0].vertices).z, 1.0, 1e-12);
}

TEST(ObjImport, PolygonsThatCrossThemselvesAreLeftOutAndBentOnesCut) {
  const auto [scene, warnings] = import_text(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 4 0 0\nv 2 1 0\nv 4 4 0\nv 0 4 0\n"
      "o bow\nf 1 2 3 4\no notched\nf 1 5 7 6 8\n");
  ASSERT_GE(scene.surfaces.size(), 2u);
  double area = 0.0;
  for (const Surface& surface : scene.surfaces) {
    EXPECT_EQ(surface.object, "notched");
    area += area_m2(surface.vertices);
  }
  EXPECT_NEAR(area, 10.0, 1e-9);
  EXPECT_THAT(warnings, HasSubstr("\"bow\": polygon that crosses itself: left out"));
}

TEST(ObjImport, Utf16IsReadByItsMark) {
  for (const bool big : {false, true}) {
    std::string text = big ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : corners + "f 1 2 3\n") {
      text += big ? '\0' : c;
      text += big ? c : '\0';
    }
    EXPECT_EQ(import_text(text).scene.surfaces.size(), 1u);
  }
}

TEST(ObjImport, FaultsNameTheirLineAndNoMoreThanTheTokenAtFault) {
  const auto fault = [](const std::string& text, const std::string& library = "") {
    return input_error([&] { import_text(text, library); });
  };
  EXPECT_THAT(fault("v 0 0 x secret\n"), HasSubstr("m.obj: line 1: \"x\" is no finite number"));
  EXPECT_THAT(fault("v 0 0 x secret\n"), testing::Not(HasSubstr("secret")));
  EXPECT_THAT(fault("v 0 0\n"), HasSubstr("too few numbers"));
  EXPECT_THAT(fault(corners + "f 1 2 6\n"), HasSubstr("line 6: a face names point \"6\" of 5"));
  EXPECT_THAT(fault(corners + "f 1 2 0\n"), HasSubstr("names point \"0\""));
  EXPECT_THAT(fault(corners + "f 1 2\n"), HasSubstr("a face has 2 corners"));
  EXPECT_THAT(fault(corners), HasSubstr("holds no faces"));
  EXPECT_THAT(fault("mtllib m.mtl\n", "Kd 1 1 1\n"),
              HasSubstr("m.mtl: line 1: \"Kd\" stands before"));
  EXPECT_THAT(fault("mtllib /etc/passwd\n"), HasSubstr("lies outside the model's folder"));
}

}  // namespace
}  // namespace enfilade
