#include "report/drawing/drawing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace enfilade {
namespace {

using ::testing::HasSubstr;

/// A red square from (2, 1) to (4, 3) m on a map of 10 x 5 m, 10 pixels a metre, at (20, 30).
Drawing square() {
  Drawing drawing;
  drawing.title = "a < b";
  drawing.width_px = 140;
  drawing.height_px = 100;
  drawing.frame = {10.0, {0.0, 0.0}, {10.0, 5.0}, {20.0, 30.0}};
  drawing.map.push_back({"cell",
                         {{{2, 1}, {4, 1}, {4, 3}, {2, 3}}},
                         Rgb8{255, 0, 0},
                         std::nullopt,
                         1.0,
                         true,
                         "x & y"});
  return drawing;
}

int red(const Bitmap& bitmap) {
  int count = 0;
  for (const Rgb8& p : bitmap.pixels) count += p == Rgb8{255, 0, 0};
  return count;
}

TEST(Drawing, PixelsAreWhereTheMapSays) {
  const Bitmap bitmap = to_bitmap(square());
  EXPECT_EQ(red(bitmap), 400);
  EXPECT_EQ(bitmap.at(40, 50), (Rgb8{255, 0, 0})) << "upper left: x = 2 m, y = 3 m";
  EXPECT_EQ(bitmap.at(59, 69), (Rgb8{255, 0, 0}));
  EXPECT_EQ(bitmap.at(39, 50), (Rgb8{255, 255, 255}));
  EXPECT_EQ(bitmap.at(40, 70), (Rgb8{255, 255, 255}));
}

TEST(Drawing, EdgesAreSmooth) {
  Drawing drawing = square();
  drawing.map[0].paths = {{{2.05, 1}, {4, 1}, {4, 3}, {2.05, 3}}};
  EXPECT_NEAR(to_bitmap(drawing).at(40, 55)[1], 128, 2) << "half a pixel is covered";
}

TEST(Drawing, TheMapIsCutOffAtItsFrame) {
  Drawing drawing = square();
  drawing.map[0].paths = {{{-5, -5}, {20, -5}, {20, 20}, {-5, 20}}};
  EXPECT_EQ(red(to_bitmap(drawing)), 100 * 50);
}

TEST(Drawing, LinesHaveTheirWidth) {
  Drawing drawing = square();
  drawing.map[0] = {"wall", {{{2, 2}, {6, 2}}}, std::nullopt, Rgb8{255, 0, 0}, 4.0, false, ""};
  EXPECT_EQ(red(to_bitmap(drawing)), 4 * 40);
}

TEST(Drawing, SvgIsInMetresWithTips) {
  const std::string svg = to_svg(square());
  EXPECT_THAT(svg, HasSubstr("<title>a &lt; b</title>"));
  EXPECT_THAT(svg, HasSubstr("matrix(10 0 0 -10 20 80)"));
  EXPECT_THAT(svg, HasSubstr(R"(fill="#ff0000" d="M2 1L4 1L4 3L2 3Z"><title>x &amp; y</title>)"));
}

}  // namespace
}  // namespace enfilade
