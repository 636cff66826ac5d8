// A host of a simulated cluster (SimGrid). Time passes only by what is charged here and by the
// messages, never by the wall clock, so that a simulation repeats to the byte.
#include <smpi/smpi.h>
#include <xbt/log.h>
#include <simgrid/s4u.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "machine/cost_model.hpp"
#include "machine/machine.hpp"
#include "machine/simulated_platform.hpp"

namespace enfilade {
namespace {

namespace s4u = simgrid::s4u;

/// A transfer that takes less than `unnoticed_s` on the wire, and less than `unnoticed_share` of
/// its disk's seek time, delays no other noticeably: it is charged as if it had the wire alone,
/// which saves a simulation of a thousand ranks most of its events.
constexpr double unnoticed_s = 1e-5, unnoticed_share = 0.05;

class SimulatedMachine final : public Machine {
 public:
  explicit SimulatedMachine(const CostModel& costs)
      : costs_(costs), here_(s4u::this_actor::get_host()) {
    check_platform(costs_.disk);
    common_ = common_servers(*here_);
    if (!here_->get_disks().empty()) local_ = {here_, here_->get_disks().front(), {}, {}};
    // All ranks were placed before the first one ran: those of one host share its memory.
    const auto ranks = std::max<std::size_t>(1, here_->get_actor_count());
    own_core_ = ranks <= static_cast<std::size_t>(here_->get_core_count());
    memory_bytes_ = memory_of(*here_) / ranks;
  }

  void compute(const WorkCount& work) override {
    settle();
    execute(price_flops(costs_, work));
  }
  void settle() override {
    if (ahead_s_ > 0.0) s4u::this_actor::sleep_for(ahead_s_);
    ahead_s_ = 0.0;
  }

  void read(Disk disk, std::uint64_t file, std::uint64_t bytes) override {
    transfer(server_of(disk, file), bytes, /*reading=*/true);
    decode(costs_.flops.byte_read * static_cast<double>(bytes));
  }
  void write(Disk disk, std::uint64_t file, std::uint64_t bytes) override {
    decode(costs_.flops.byte_written * static_cast<double>(bytes));
    transfer(server_of(disk, file), bytes, /*reading=*/false);
  }
  void move_to_common(std::uint64_t file, std::uint64_t bytes) override {
    const Server &from = server_of(Disk::local, file), &to = server_of(Disk::common, file);
    if (from.disk == to.disk) {
      request(to, 0, false);  // a new name for the file
    } else {
      transfer(from, bytes, true);
      transfer(to, bytes, false);
    }
  }
  std::uint64_t record_bytes(const RecordCount& count) const override {
    return price_record(costs_, count);
  }
  std::uint64_t memory_bytes() const override { return memory_bytes_; }
  double now_s() const override { return s4u::Engine::get_clock() + ahead_s_; }
  void pause(int turn) override {
    constexpr double first_s = 1e-6;  // the n-th pause in a row takes n times as long,
    constexpr int most = 1000;        // up to a millisecond
    ahead_s_ += first_s * std::min(turn + 1, most);
    settle();
  }
  bool time_passes_by_itself() const override { return false; }
  void wait_for_message(const std::function<bool()>&, const std::function<bool()>& block) override {
    settle();
    while (!block()) continue;
  }
  std::string host() const override { return here_->get_name(); }
  void describe(RunRecord& record, double longest_s) const override {
    record.set("simulated_s", RunRecord::Value(longest_s));
  }

 private:
  static void execute(double flops) {
    if (flops > 0.0) smpi_execute_flops(flops);
  }
  /// Charges turning bytes into records or back. A rank with a core of its own, at its usual speed,
  /// knows how long that takes: the time is added to `ahead_s_` and passes with the next request,
  /// which saves the simulation an event.
  void decode(double flops) {
    if (own_core_ && here_->get_available_speed() == 1.0) {
      ahead_s_ += std::max(0.0, flops) / here_->get_speed();
    } else {
      settle();
      execute(flops);
    }
  }
  /// Files are spread over the common disks by their number; a host without a disk has its local
  /// directory on the common one, as the paper's hosts had.
  const Server& server_of(Disk disk, std::uint64_t file) const {
    if (disk == Disk::local && local_.disk != nullptr) return local_;
    return common_[file % common_.size()];
  }
  /// Charges a transfer in requests of at most `request_bytes`. A section of 0 bytes costs nothing:
  /// the modelled program keeps it in a file that is charged elsewhere.
  void transfer(const Server& server, std::uint64_t bytes, bool reading) {
    while (bytes > 0) {
      const std::uint64_t part = std::min(bytes, costs_.disk.request_bytes);
      request(server, part, reading);
      bytes -= part;
    }
  }
  /// Reading: arm, then wire. Writing: wire, then arm.
  void request(const Server& server, std::uint64_t bytes, bool reading) {
    const bool remote = server.host != here_;
    DiskArm& arm = arm_of(*server.disk, costs_.disk);
    if (remote && !reading) send(here_, server.host, server.to, bytes, arm);
    // Every remote request is later by the same request_s, so that the order of requests is known
    // when they are made (but for the time that a rank decodes before its next request).
    const double come_s = now_s() + (remote ? arm.request_s : 0.0);
    // The transfer has the disk's whole bandwidth, as SimGrid's own disk activity would have; but
    // SimGrid keeps each such activity in a list that later ones have to search.
    const double bandwidth =
        reading ? server.disk->get_read_bandwidth() : server.disk->get_write_bandwidth();
    const double seconds = arm.seek_s + static_cast<double>(bytes) / bandwidth;
    arm.free_s = arm.others.end_s(std::max(come_s, arm.free_s), seconds);
    s4u::this_actor::sleep_until(arm.free_s);
    ahead_s_ = 0.0;
    if (remote && reading) send(server.host, here_, server.from, bytes, arm);
  }
  void send(s4u::Host* from, s4u::Host* to, const Wire& wire, std::uint64_t bytes,
            const DiskArm& arm) {
    if (bytes == 0) return;
    const double transfer_s = wire.transfer_s(bytes);
    if (transfer_s < std::min(unnoticed_s, unnoticed_share * arm.seek_s)) {
      ahead_s_ += wire.latency_s + transfer_s;
    } else {
      settle();
      s4u::Comm::sendto(from, to, bytes);
    }
  }

  CostModel costs_;
  s4u::Host* here_;
  std::vector<Server> common_;
  Server local_;
  std::uint64_t memory_bytes_ = 0;
  bool own_core_ = true;
  double ahead_s_ = 0.0;  ///< charged time that SimGrid's clock has not passed yet
};

}  // namespace

bool ranks_share_a_process() { return true; }

std::unique_ptr<Machine> make_machine(const CostModel& costs) {
  // Only charged work takes time, whatever smpirun's command line said; and a poll for messages
  // takes none, since it is cheap on a real machine.
  xbt_log_control_set("xbt_cfg.thres:warning");
  s4u::Engine::set_config("smpi/simulate-computation:no");
  s4u::Engine::set_config("smpi/test:0");
  s4u::Engine::set_config("smpi/iprobe:0");
  s4u::Engine::set_config("smpi/grow-injected-times:no");
  return std::make_unique<SimulatedMachine>(costs);
}

}  // namespace enfilade
