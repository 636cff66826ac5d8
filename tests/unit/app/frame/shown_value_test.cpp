#include "app/frame/shown_value.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(ShownValue, FollowsTheUnitThatTheKeyEndsWith) {
  using Value = RunRecord::Value;
  EXPECT_EQ(shown_value("links", Value(std::int64_t{1234567})), "1,234,567");
  EXPECT_EQ(shown_value("peak_rss_bytes", Value(std::int64_t{3 << 20})), "3.0 MiB");
  EXPECT_EQ(shown_value("solve_s", Value(90.0)), "1 min 30 s");
  EXPECT_EQ(shown_value("estimated_error", Value(0.0173)), "1.7%");
  EXPECT_EQ(shown_value("io_s", Value(std::vector<double>{1.0, 2.5})), "1.00 s, 2.50 s");
  EXPECT_EQ(shown_value("converged", Value(true)), "yes");
}

}  // namespace
}  // namespace enfilade
