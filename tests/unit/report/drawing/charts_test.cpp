#include "report/drawing/charts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

namespace enfilade {
namespace {

std::vector<double> attribute(const std::string& svg, const std::string& element,
                              const std::string& name) {
  std::vector<double> values;
  const std::regex pattern("<" + element + " [^>]*" + name + "=\"([-0-9.]+)\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), pattern), end; it != end; ++it)
    values.push_back(std::stod((*it)[1]));
  return values;
}

TEST(Charts, ALineFallsEvenlyOverDecades) {
  const std::string svg =
      line_chart({{"error", "#123456", {{1, 1.0}, {2, 0.1}, {3, 0.01}}}}, "iteration", "error");
  const auto y = attribute(svg, "circle", "cy"), x = attribute(svg, "circle", "cx");
  ASSERT_EQ(y.size(), 3u);
  EXPECT_NEAR(y[1] - y[0], y[2] - y[1], 0.11);
  EXPECT_GT(y[1], y[0]);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.11);
}

TEST(Charts, LeavesOutWhatHasNoLogarithm) {
  const std::string svg =
      line_chart({{"e", "#123456", {{1, 0.0}, {2, std::nan("")}, {3, 5.0}}}}, "x", "y");
  EXPECT_EQ(attribute(svg, "circle", "cy").size(), 1u);
  EXPECT_EQ(line_chart({{"e", "#123456", {{1, 0.0}}}}, "x", "y"), "");
  EXPECT_EQ(line_chart({}, "x", "y"), "");
}

TEST(Charts, BarsAreAsLongAsTheirTime) {
  const std::string svg =
      stacked_bars({"rank 0", "rank 1"},
                   {{"computing", "red", {3.0, 1.0}}, {"waiting", "grey", {1.0, 3.0}}}, "s");
  const auto width = attribute(svg, "rect", "width"), x = attribute(svg, "rect", "x");
  ASSERT_EQ(width.size(), 4u);
  EXPECT_NEAR(width[0], 3.0 * width[1], 0.2);
  EXPECT_NEAR(width[0] + width[1], width[2] + width[3], 0.2);
  EXPECT_NEAR(x[1], x[0] + width[0], 0.11) << "the second layer starts where the first ends";
  EXPECT_EQ(stacked_bars({"rank 0"}, {{"computing", "red", {0.0}}}, "s"), "");
}

TEST(Charts, TextIsMadeSafe) {
  EXPECT_EQ(escaped("a<b & \"c\""), "a&lt;b &amp; &quot;c&quot;");
  EXPECT_THAT(line_chart({{"<script>", "#123456", {{1, 1.0}}}}, "x", "y"),
              testing::Not(testing::HasSubstr("<script>")));
}

}  // namespace
}  // namespace enfilade
