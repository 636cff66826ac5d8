#include "report/page/rank_timeline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace enfilade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// One rank computes for 3 s and reads for 1 s; the other waits for 4 s.
std::vector<RankProfile> two_ranks() {
  std::vector<RankProfile> ranks{{"ash", PhaseProfile(1.0)}, {"elm", PhaseProfile(1.0)}};
  ranks[0].profile.add(Phase::compute, 10.0, 13.0);
  ranks[0].profile.add(Phase::io, 13.0, 14.0);
  ranks[1].profile.add(Phase::wait, 10.0, 14.0);
  return ranks;
}

double area_px2(const Shape& shape) {
  double sum = 0.0;
  for (const Path& p : shape.paths) sum += (p[2].x - p[0].x) * std::abs(p[2].y - p[0].y);
  return sum;
}

TEST(RankTimeline, AreasAreTheShareOfTime) {
  const Drawing drawing = rank_timeline(two_ranks());
  std::vector<double> areas;
  for (const Shape& shape : drawing.sheet) {
    if (shape.kind == "phase") areas.push_back(area_px2(shape));
  }
  ASSERT_EQ(areas.size(), 3u);  // compute, I/O, wait
  EXPECT_NEAR(areas[0] / areas[1], 3.0, 1e-9);
  EXPECT_NEAR(areas[2] / areas[1], 4.0, 1e-9);
}

TEST(RankTimeline, NamesHostsAndPhases) {
  std::string words;
  for (const Words& w : rank_timeline(two_ranks()).words) words += w.text + "|";
  EXPECT_THAT(words, HasSubstr("0 ash|"));
  EXPECT_THAT(words, HasSubstr("1 elm|"));
  EXPECT_THAT(words, HasSubstr("I/O|"));
}

TEST(RankTimeline, AThousandRanksFitOnASheet) {
  std::vector<RankProfile> ranks;
  for (int i = 0; i < 1024; ++i) {
    ranks.push_back({"node", PhaseProfile(1.0)});
    ranks.back().profile.add(Phase::compute, 0.0, 100.0 + i % 7);
  }
  const Drawing drawing = rank_timeline(ranks);
  EXPECT_LT(drawing.height_px, 1000);
  EXPECT_LT(to_svg(drawing).size(), 4'000'000u);
}

TEST(RankTimeline, NothingDoneIsAnEmptySheet) {
  EXPECT_TRUE(rank_timeline({}).sheet.empty());
  EXPECT_TRUE(rank_timeline({{"ash", PhaseProfile()}}).sheet.empty());
}

TEST(PajeTrace, TellsEachChangeOfState) {
  const std::string trace = paje_trace(two_ranks());
  EXPECT_THAT(trace, HasSubstr("3 0 rank0 RANK 0 \"rank 0 on ash\"\n"));
  EXPECT_THAT(trace, HasSubstr("5 0 PHASE rank0 phase0\n"));  // from when the first began
  EXPECT_THAT(trace, HasSubstr("5 3 PHASE rank0 phase1\n"));
  EXPECT_THAT(trace, Not(HasSubstr("5 1 PHASE")));
  EXPECT_THAT(trace, HasSubstr("4 4 RANK rank1\n"));
}

}  // namespace
}  // namespace enfilade
