#include "machine/machine.hpp"

#include <gtest/gtest.h>

#include "machine/cost_model.hpp"

namespace enfilade {
namespace {

/// A machine whose clock the test winds by hand.
class Clock final : public Machine {
 public:
  void compute(const WorkCount& work) override { charged.push_back(work); }
  void read(Disk, std::uint64_t, std::uint64_t) override {}
  void write(Disk, std::uint64_t, std::uint64_t) override {}
  void move_to_common(std::uint64_t, std::uint64_t) override {}
  std::uint64_t record_bytes(const RecordCount& count) const override { return count.bytes; }
  std::uint64_t memory_bytes() const override { return 0; }
  double now_s() const override { return now; }
  void pause(int) override {}
  bool time_passes_by_itself() const override { return by_itself; }
  std::string host() const override { return "clock"; }
  double now = 0.0;
  bool by_itself = false;
  std::vector<WorkCount> charged;
};

TEST(Machine, EverySecondBelongsToThePhaseItWasSpentIn) {
  Clock clock;
  clock.now = 2.0;
  {
    const PhaseScope reading(clock, Phase::io);
    clock.now = 5.0;
    {
      const PhaseScope waiting(clock, Phase::token);
      clock.now = 9.0;
    }
    clock.now = 10.0;
  }
  clock.now = 16.0;
  const TimeUse use = clock.time_use();
  EXPECT_DOUBLE_EQ(use.compute_s, 8.0);
  EXPECT_DOUBLE_EQ(use.io_s, 4.0);
  EXPECT_DOUBLE_EQ(use.idle_s, 4.0);
}

TEST(Machine, ListensBetweenThePartsOfWorkWhereOnlyChargesTakeTime) {
  Clock clock;
  WorkCount work;
  work.rays = 5000;
  work.patches = 7;
  std::size_t listened = 0;
  clock.compute_in_parts(work, [&] { EXPECT_EQ(++listened, clock.charged.size()); });
  EXPECT_EQ(listened, 10u) << "512 operations a part";
  WorkCount sum;
  for (const WorkCount& part : clock.charged) sum += part;
  EXPECT_EQ(sum.rays, work.rays);
  EXPECT_EQ(sum.patches, work.patches);
}

TEST(Machine, ListensOnceWhereWorkTakesItsTimeByItself) {
  Clock clock;
  clock.by_itself = true;
  WorkCount work;
  work.rays = 5000;
  int listened = 0;
  clock.compute_in_parts(work, [&] { ++listened; });
  EXPECT_EQ(listened, 1);
}

TEST(Machine, PollsUntilAMessageIsThere) {
  Clock clock;
  int polls = 0;
  clock.wait_for_message([&] { return ++polls == 3; }, [] { return false; });
  EXPECT_EQ(polls, 3);
}

TEST(Machine, RealOneKeepsTheTimeAndChargesNothing) {
  const auto machine = make_machine({});
  EXPECT_TRUE(machine->time_passes_by_itself());
  EXPECT_GT(machine->peak_memory_bytes(0), 0u) << "measured, not counted";
  EXPECT_FALSE(machine->host().empty());
  const double before = machine->now_s();
  WorkCount work;
  work.rays = 1000000000;
  machine->compute(work);
  machine->read(Disk::common, 1, std::uint64_t{1} << 40);
  EXPECT_LT(machine->now_s() - before, 1.0);
  EXPECT_EQ(machine->record_bytes({1, 2, 3, 77}), 77u);
}

}  // namespace
}  // namespace enfilade
