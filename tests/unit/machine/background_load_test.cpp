#include "machine/background_load.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace enfilade {
namespace {

BackgroundLoad load(const std::string& text) { return {text, "platform", "disk d: background"}; }

TEST(BackgroundLoad, AnIdleDiskTakesItsTime) {
  EXPECT_DOUBLE_EQ(BackgroundLoad().end_s(5.0, 2.0), 7.0);
}

TEST(BackgroundLoad, AShareOfTheTimeStretchesTheWork) {
  EXPECT_DOUBLE_EQ(load("0.5").end_s(5.0, 2.0), 9.0);
}

TEST(BackgroundLoad, AProfileIsFollowedFromStepToStep) {
  const BackgroundLoad busy_later = load("0 0, 10 0.75");
  EXPECT_DOUBLE_EQ(busy_later.end_s(0.0, 10.0), 10.0);
  EXPECT_DOUBLE_EQ(busy_later.end_s(8.0, 3.0), 14.0);  // 2 s before the step, then 1 s of work in 4
}

TEST(BackgroundLoad, AProfileComesRoundAgain) {
  const BackgroundLoad days = load("0 0.5, 10 0, repeat 20");
  EXPECT_DOUBLE_EQ(days.end_s(0.0, 15.0), 20.0);
  EXPECT_DOUBLE_EQ(days.end_s(0.0, 16.0), 22.0);
  EXPECT_DOUBLE_EQ(days.end_s(1005.0, 2.5), 1010.0);
  EXPECT_DOUBLE_EQ(days.end_s(1015.0, 6.0), 1022.0);
}

TEST(BackgroundLoad, AShortRoundEndsSoonWheneverItBegins) {
  const BackgroundLoad busy = load("0 0.5, 1e-9 0, repeat 2e-9");
  EXPECT_NEAR(busy.end_s(0.0, 1000.0), 4000.0 / 3.0, 1e-6);
  EXPECT_NEAR(busy.end_s(1e9, 3.0), 1e9 + 4.0, 1e-6);
  EXPECT_NEAR(load("0 0.5, repeat 1e-300").end_s(5.0, 2.0), 9.0, 1e-9);
}

TEST(BackgroundLoad, RefusesWhatIsNoLoad) {
  for (const char* text : {"", "1", "-0.1", "much", "0 0.1, 5", "3 0.1", "0 0.1, 5 0.2, 5 0.3",
                           "0 0.1, repeat 0", "repeat 5", "0.2x"}) {
    EXPECT_THROW(load(text), InputError) << text;
  }
}

}  // namespace
}  // namespace enfilade
