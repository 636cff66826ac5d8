#include "building_file/description.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/modeler/buildings.hpp"

namespace enfilade {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string fault_of(const std::string& text, const std::vector<BuildingOption>& options = {}) {
  try {
    describe_building(text, "b.json", options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Description, SaysWhatItsKeysSay) {
  const Building b = describe_building(
      R"({"floors": 4, "wings": [{"bays": 5}, {"bays": 6, "turn": -20}], "room_depth": 6,
          "windows": "closed", "furniture": {"lamp": 7}, "colours": true, "stairs": 0})",
      "b.json");
  EXPECT_EQ(b.floors, 4);
  ASSERT_EQ(b.wings.size(), 2u);
  EXPECT_EQ(b.bays(), 11);
  EXPECT_EQ(b.wings[1].turn_deg, -20.0);
  EXPECT_EQ(b.room_depth_m, 6.0);
  EXPECT_EQ(b.windows, Windows::closed);
  EXPECT_EQ(b.furniture[index_of(FurnitureKind::lamp)], 7);
  EXPECT_TRUE(b.colours);
}

TEST(Description, OptionsReplaceKeysAndKeepOtherFurniture) {
  const Building b = describe_building(
      R"({"floors": 4, "furniture": {"lamp": 7, "bin": 2}})", "b",
      std::vector<BuildingOption>{{"floors", "2"}, {"wings", "5,6:-20"}, {"furniture", "bin=3"}});
  EXPECT_EQ(b.floors, 2);
  EXPECT_EQ(b.wings.at(1).turn_deg, -20.0);
  EXPECT_EQ(b.furniture[index_of(FurnitureKind::lamp)], 7);
  EXPECT_EQ(b.furniture[index_of(FurnitureKind::bin)], 3);
}

TEST(Description, FaultsNameTheirKey) {
  const std::pair<const char*, const char*> faults[] = {
      {R"([])", "b.json: top level: is not an object"},
      {R"({"flors": 2})", "b.json: \"flors\": is no key"},
      {R"({"format": "enfilade-scene"})", "b.json: format: "},
      {R"({"floors": 0})", "b.json: floors: is 0"},
      {R"({"floors": 2.5})", "b.json: floors: is 2.5"},
      {R"({"floors": NaN})", "b.json: floors: is \"NaN\""},
      {R"({"rotate": "left"})", "b.json: rotate: is \"left\""},
      {R"({"entrance": 1})", "b.json: entrance: is 1"},
      {R"({"wings": []})", "b.json: wings: is []"},
      {R"({"wings": [{"bays": 3}, {"turn": 4}]})", "b.json: wings[1]: "},
      {R"({"wings": [{"bays": 0}]})", "b.json: wings[0].bays: is 0"},
      {R"({"wings": [{"bays": 3, "trun": 4}]})", "b.json: wings[0].trun: is no key"},
      {R"({"wings": [{"bays": 3}, {"bays": 4, "turn": 80}]})",
       "b.json: wings[1]: leaves its inner"},
      {R"({"wings": [{"bays": 20, "turn": 170}, {"bays": 20, "turn": 170},
                   {"bays": 4}]})",
       "b.json: wings[2]: runs into wings[0]"},
      {R"({"windows": "ajar"})", "b.json: windows: is \"ajar\""},
      {R"({"furniture": 3})", "b.json: furniture: is 3"},
      {R"({"furniture": {"sofa": 3}})", "b.json: furniture.sofa: is no kind"},
      {R"({"furniture": {"chair": -1}})", "b.json: furniture.chair: is -1"},
      {R"({"furniture": {"chair": 999}})", "b.json: furniture.chair: asks for 999"},
      {R"({"ground_furniture": {"chair": 999}})", "b.json: ground_furniture.chair: asks for 999"},
      {R"({"furniture": {"monitor": 1}})", "b.json: furniture.monitor: asks for 1"},
      {R"({"window_head": 1.6, "window_sill": 1.5})", "b.json: window_head: "},
      {R"({"room_height": 2.4, "door_height": 2.3, "window_head": 2.35})", "b.json: room_height: "},
      {R"({"room_height": 5})", "b.json: room_depth: leaves no room for stairs"},
      {R"({"stairs": 9})", "b.json: stairs: are more than the 8 bays"},
      {R"({"fire_doors": 8})", "b.json: fire_doors: are more"},
      {"{", "b.json: line 1:"}};
  for (const auto& [text, fault] : faults) {
    EXPECT_THAT(fault_of(text), AllOf(HasSubstr(fault), HasSubstr("; "), Not(HasSubstr("\n"))))
        << text;
  }
}

TEST(Description, FaultsOfOptionsNameTheOption) {
  EXPECT_THAT(fault_of("{}", {{"floors", "none"}}),
              HasSubstr("command line: --floors: is \"none\""));
  EXPECT_THAT(fault_of("{}", {{"wings", "3,4:80"}}),
              HasSubstr("command line: --wings: wings[1] leaves its inner"));
  EXPECT_THAT(fault_of("{}", {{"furniture", "chair"}}),
              HasSubstr("command line: --furniture: has \"chair\""));
  EXPECT_THAT(fault_of("{}", {{"furniture", "sofa=2"}}),
              HasSubstr("command line: --furniture: furniture.sofa is no kind"));
}

TEST(Description, EveryPresetIsABuilding) {
  EXPECT_EQ(preset_names(), "demo, rr3425");
  for (const char* name : {"demo", "rr3425"}) EXPECT_NO_THROW(testing::preset(name)) << name;
  EXPECT_FALSE(preset_description("palace"));
}

}  // namespace
}  // namespace enfilade
