#include "report/room_table/room_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace enfilade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

RoomTable table_of(const std::string& name) {
  RoomFigures room;
  room.room.name = name;
  room.room.plan = RoomPlan(std::vector<Vec2>{{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  room.room.area_m2 = 12.0;
  room.room.ceiling_m = 3.0;
  room.room.required = 300.0;
  room.grid = calculation_grid(room.room.plan);
  room.plane_m = 0.75;
  for (std::size_t i = 0; i < room.grid.points.size(); ++i)
    room.values.push_back({room.grid.points[i], room.grid.cell[i], 200.0 + 10.0 * i});
  room.mean = Estimate{310.0, 2.0};
  room.minimum = Estimate{200.0, 3.0};
  room.maximum = Estimate{400.0, 3.0};
  room.u0 = Estimate{0.645, 0.01};
  RoomTable table;
  table.rooms.push_back(room);
  table.unit = "lx";
  return table;
}

TEST(RoomTable, NamesInCsvAreNoFormulasAndKeepTheirCommas) {
  EXPECT_THAT(rooms_csv(table_of("=1+1")), HasSubstr("\n'=1+1,"));
  EXPECT_THAT(rooms_csv(table_of("office, north")), HasSubstr("\n\"office, north\","));
  EXPECT_THAT(rooms_csv(table_of("a")),
              StartsWith("room,long_name,storey,area_m2,height_m,points,"));
}

TEST(RoomTable, NamesInHtmlAreText) {
  const std::string html = rooms_html(table_of("<script>alert(1)</script>"));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(1)"));
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
}

TEST(RoomTable, FiguresThatAreNotKnownAreEmptyFields) {
  const std::string csv = rooms_csv(table_of("a"));
  EXPECT_THAT(csv, HasSubstr(",lx,310,200,400,0.645,2,3,3,0.01,,,,,,,,,,,,,300,met,,1,"));
}

TEST(RoomTable, DaylightFactorsAreSharesOfTheLightOutside) {
  RoomTable table = table_of("a");
  table.rooms[0].median = Estimate{300.0, 4.0};
  EXPECT_THAT(rooms_html(table), Not(HasSubstr("D median")));
  table.outside = 10000.0;
  EXPECT_THAT(rooms_csv(table), HasSubstr(",0.01,,,,,,,3.1,0.02,2,0.03,3,0.04,300,met,,1,"));
  EXPECT_THAT(rooms_html(table), HasSubstr("D median"));
}

TEST(Verdict, NeedsTwoStandardDeviations) {
  RoomFigures room = table_of("a").rooms[0];
  EXPECT_EQ(verdict_of(room), Verdict::met);
  room.mean->error = 6.0;
  EXPECT_EQ(verdict_of(room), Verdict::within_error);
  room.mean = Estimate{280.0, 2.0};
  EXPECT_EQ(verdict_of(room), Verdict::not_met);
  room.room.required = 0.0;
  EXPECT_EQ(verdict_of(room), Verdict::none_asked);
}

}  // namespace
}  // namespace enfilade
