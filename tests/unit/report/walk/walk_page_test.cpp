#include "report/walk/walk_page.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

using test::LitRooms;

constexpr const char* program =
    "<title><!--title--></title><script><!--model--></script><!--data-->";

nlohmann::json model_of(const std::string& page) {
  const std::string begin = "<script>", end = "</script>";
  const std::size_t from = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(from, page.find(end, from) - from));
}

TEST(WalkPage, TellsTheRoomsAndWhereToStand) {
  LitRooms rooms(2);
  rooms.set_irradiance([](const Vec3& p) { return p.x < 4.1 ? 20.0 : 60.0; });
  const std::vector<SurveyRoom> list = rooms_of_building(rooms.solved().building(), {});
  const auto views = standing_views(rooms.solved(), list);
  const nlohmann::json model = model_of(walk_html({rooms.solved(), "house", list, views}, program));
  EXPECT_EQ(model["unit"], "lx");
  EXPECT_FALSE(model["surveyed"]);
  ASSERT_EQ(model["rooms"].size(), 2u);
  EXPECT_NEAR(model["rooms"][1]["floorLight"], 60.0, 1e-6);
  EXPECT_EQ(model["rooms"][0]["storey"], 0);
  const double eye_m = model["rooms"][0]["eye"][2].get<double>() + model["centre"][2].get<double>();
  EXPECT_NEAR(eye_m, 1.6, 1e-6);
  EXPECT_GE(model["start"], 0);
  ASSERT_EQ(model["storeys"].size(), 1u);
}

TEST(WalkPage, KeepsNamesOutOfTheMarkup) {
  LitRooms rooms;
  rooms.set_irradiance([](const Vec3&) { return 20.0; });
  std::vector<SurveyRoom> list = rooms_of_building(rooms.solved().building(), {});
  const auto views = standing_views(rooms.solved(), list);
  list[0].name = "</script><b><!--data-->";
  const std::string page = walk_html({rooms.solved(), "a <i> & b", list, views}, program);
  EXPECT_NE(page.find("<title>a &lt;i&gt; &amp; b</title>"), std::string::npos);
  EXPECT_EQ(model_of(page)["rooms"][0]["name"], list[0].name);
  EXPECT_EQ(page.find("<b>"), std::string::npos);
  EXPECT_EQ(page.find("<!--"), std::string::npos) << "each mark is replaced, and no name is one";
}

TEST(WalkPage, ShowsTheTableOfASurveyedBuilding) {
  LitRooms rooms;
  rooms.set_irradiance([](const Vec3&) { return 20.0; });
  const std::vector<SurveyRoom> list = rooms_of_building(rooms.solved().building(), {});
  const auto views = standing_views(rooms.solved(), list);
  RoomTable table;
  RoomFigures figures;
  figures.room = list[0];
  figures.room.required = 300.0;
  figures.mean = Estimate{311.0, 1.0};
  figures.u0 = Estimate{0.7, 0.01};
  table.rooms.push_back(figures);
  const nlohmann::json model =
      model_of(walk_html({rooms.solved(), "house", list, views, &table}, program));
  EXPECT_TRUE(model["surveyed"]);
  EXPECT_EQ(model["rooms"][0]["mean"], 311.0);
  EXPECT_EQ(model["rooms"][0]["required"], 300.0);
  EXPECT_EQ(model["rooms"][0]["verdict"], "met");
}

}  // namespace
}  // namespace enfilade
