#include "import/ifc/ifc_answer.hpp"

#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;

/// An answer with one triangle, in which `corners` are its points' numbers.
std::string answer(const std::string& corners, const std::string& rooms = "") {
  return R"({"schema": "IFC4", "warnings": [], "portals": [], "luminaires": [], "rooms": [)" +
         rooms +
         R"(], "elements": [{"type": "IfcWall", "name": "w", "object": "IfcWall/1", "parts": [
         {"points": [0,0,0, 1,0,0, 0,1,0], "triangles": [)" +
         corners + R"(], "colour": [0.5,0.5,0.5,1]}]}]})";
}

Scene scene_of(const std::string& text) {
  Warnings warnings;
  return scene_from_ifc_answer(text, "m.ifc", {}, warnings);
}

TEST(IfcAnswer, IsMadeAScene) { EXPECT_EQ(scene_of(answer("0,1,2")).surfaces.size(), 1u); }

TEST(IfcAnswer, WhatItShouldNotHoldIsOneLineAboutTheModel) {
  for (const char* corners : {"0,1,3", "0,-1,2", "0,1,1e300", "0,1,\"x\"", "0,null,2"})
    EXPECT_THAT(input_error([&] { scene_of(answer(corners)); }), HasSubstr("m.ifc: file: misled"))
        << corners;
  for (const char* text :
       {"{}", R"({"elements": 7})", R"({"fault": 7})", R"({"fault": "malformed"})",
        R"({"warnings": [], "elements": [], "rooms": [], "portals": [], "luminaires":
            [{"name": "l", "type": "", "p": [0,0,0], "flux_lm": 1, "aim": [0,0,-1]}]})"})
    EXPECT_THAT(input_error([&] { scene_of(text); }), HasSubstr("m.ifc: file: misled")) << text;
  EXPECT_THAT(input_error([&] { scene_of(answer("0,1,2", R"({"box": [[0,0]]})")); }),
              HasSubstr("m.ifc: file: misled"));
  for (const char* text : {"", "[1]", R"({"elements": [)"})
    EXPECT_THAT(input_error([&] { scene_of(text); }), HasSubstr("within its answer")) << text;
}

}  // namespace
}  // namespace enfilade
