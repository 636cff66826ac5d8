// The real machine: work and bytes take the time that they take.
#include <malloc.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "base/peak_memory.hpp"
#include "machine/cost_model.hpp"
#include "machine/machine.hpp"

namespace enfilade {
namespace {

class RealMachine final : public Machine {
 public:
  void compute(const WorkCount&) override {}
  void read(Disk, std::uint64_t, std::uint64_t) override {}
  void write(Disk, std::uint64_t, std::uint64_t) override {}
  void move_to_common(std::uint64_t, std::uint64_t) override {}
  std::uint64_t record_bytes(const RecordCount& count) const override { return count.bytes; }
  std::uint64_t memory_bytes() const override { return 0; }
  std::uint64_t peak_memory_bytes(std::uint64_t) const override { return peak_rss_bytes(); }
  void return_freed_memory() override { malloc_trim(0); }

  double now_s() const override {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  bool time_passes_by_itself() const override { return true; }
  // A rank that waits must leave its core to one that works, where there are more ranks than cores.
  void pause(int turn) override {
    constexpr int turns_without_sleep = 20;  // an answer that comes at once is not slept through
    constexpr int longest_sleep_us = 400;    // bounds the delay of a message that comes late
    if (turn < turns_without_sleep) {
      sched_yield();
    } else {
      std::this_thread::sleep_for(std::chrono::microseconds(std::min(turn, longest_sleep_us)));
    }
  }
  std::string host() const override {
    char name[256] = {};
    return gethostname(name, sizeof name - 1) == 0 ? name : "localhost";
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

bool ranks_share_a_process() { return false; }

std::unique_ptr<Machine> make_machine(const CostModel&) { return std::make_unique<RealMachine>(); }

}  // namespace enfilade
