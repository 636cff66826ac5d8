// A host of a simulated cluster: the only file that names SimGrid. Time passes only by what is
// charged here and by the messages; never by the wall clock, so that a simulation repeats to the
// byte.
#include <smpi/smpi.h>
#include <xbt/log.h>
#include <simgrid/s4u.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/nearest_word.hpp"
#include "machine/background_load.hpp"
#include "machine/cost_model.hpp"
#include "machine/machine.hpp"

namespace enfilade {
namespace {

namespace s4u = simgrid::s4u;

/// The arm of a disk: first come, first served, one request at a time. All ranks share one address
/// space, so it hangs on the disk itself, where every rank finds it. When a request is done is
/// known as soon as it has come: those before it have said how long they take.
struct DiskArm {
  double free_s = 0.0;  ///< when it is done with all requests so far
  double seek_s = 0.0;
  double request_s = 0.0;  ///< of a client on another host
  BackgroundLoad others;
};

/// The disk's own property, or the cost model's value.
double seconds_of(const s4u::Disk& disk, const char* key, double of_model) {
  const char* own = disk.get_property(key);
  if (own == nullptr) return of_model;
  char* end = nullptr;
  const double seconds = std::strtod(own, &end);
  if (end != own && *end == '\0' && seconds >= 0.0 && std::isfinite(seconds)) return seconds;
  throw InputError("platform", "disk " + disk.get_name() + ": " + key,
                   "'" + std::string(own) + "' is not a number of seconds from 0 up",
                   "give it as platforms/README.md shows");
}

/// A property that nobody reads may be another program's; one that is nearly ours was misspelt.
template <class Described>
void refuse_misspelt(const Described& described, const std::string& what,
                     const std::vector<std::string>& ours, const std::string& others_place,
                     const std::vector<std::string>& others) {
  for (const auto& [key, value] : *described.get_properties()) {
    if (std::find(ours.begin(), ours.end(), key) != ours.end()) continue;
    const std::string place = what + " " + described.get_name() + ": " + key;
    if (std::find(others.begin(), others.end(), key) != others.end()) {
      throw InputError("platform", place, "no such property here", "put it into " + others_place);
    }
    const std::string meant = nearest_word(key, ours);
    if (meant.empty()) continue;
    throw InputError("platform", place, "no such property", "did you mean '" + meant + "'?");
  }
}

void refuse_misspelt(const s4u::Host& host) {
  const std::vector<std::string> of_hosts{"memory", "serves"};
  const std::vector<std::string> of_disks{"background", "request_s", "seek_s"};
  refuse_misspelt(host, "host", of_hosts, "the host's <disk>", of_disks);
  const char* serves = host.get_property("serves");
  if (serves != nullptr && std::string(serves) != "common" && std::string(serves) != "alone") {
    throw InputError("platform", "host " + host.get_name() + ": serves",
                     "'" + std::string(serves) + "' is neither common nor alone",
                     "give it as platforms/README.md shows");
  }
  for (const s4u::Disk* disk : host.get_disks()) {
    refuse_misspelt(*disk, "disk", of_disks, "the <host>", of_hosts);
  }
}

/// Made by the first rank that comes by; lives as long as the simulation.
DiskArm& arm_of(s4u::Disk& disk, const DiskCosts& costs) {
  if (disk.get_data<DiskArm>() == nullptr) {
    if (!(disk.get_read_bandwidth() > 0.0 && disk.get_write_bandwidth() > 0.0)) {
      throw InputError("platform", "disk " + disk.get_name(),
                       "read_bw and write_bw must be above 0",
                       "give them as platforms/README.md shows");
    }
    auto arm = std::make_unique<DiskArm>();
    arm->seek_s = seconds_of(disk, "seek_s", costs.seek_s);
    arm->request_s = seconds_of(disk, "request_s", costs.request_s);
    if (const char* others = disk.get_property("background")) {
      arm->others = BackgroundLoad(others, "platform", "disk " + disk.get_name() + ": background");
    }
    disk.set_data(arm.release());
  }
  return *disk.get_data<DiskArm>();
}

/// The way of bytes from one host to another.
struct Wire {
  std::vector<s4u::Link*> links;
  double latency_s = 0.0;

  double transfer_s(std::uint64_t bytes) const {
    double bandwidth = std::numeric_limits<double>::infinity();
    for (const s4u::Link* link : links) bandwidth = std::min(bandwidth, link->get_bandwidth());
    return static_cast<double>(bytes) / bandwidth;
  }
};

Wire wire_between(const s4u::Host& from, const s4u::Host& to) {
  Wire wire;
  if (&from == &to) return wire;
  from.route_to(&to, wire.links, &wire.latency_s);
  if (wire.links.empty()) {
    throw InputError("platform", "routes",
                     "no way from " + from.get_name() + " to " + to.get_name(),
                     "give a <route> between them as platforms/README.md shows");
  }
  return wire;
}

/// A disk and the host that it hangs on, and the wires from and to a rank's host.
struct Server {
  s4u::Host* host = nullptr;
  s4u::Disk* disk = nullptr;
  Wire from, to;
};

/// Bytes that have a wire for so short a time, and for so small a share of what their disk takes
/// for them, leave it before others could notice: they are charged as if alone, which saves a
/// simulation of a thousand ranks most of its events.
constexpr double unnoticed_s = 1e-5, unnoticed_share = 0.05;

bool has_property(const s4u::Host& host, const char* key, const char* value) {
  const char* is = host.get_property(key);
  return is != nullptr && std::string(is) == value;
}

/// The disks of the common directory, as seen from `here`.
std::vector<Server> common_servers(s4u::Host& here) {
  std::vector<Server> servers;
  // All ranks were placed before the first one ran.
  const bool alone = here.get_actor_count() == s4u::Engine::get_instance()->get_actor_count();
  if (alone && has_property(here, "serves", "alone")) {
    for (s4u::Disk* disk : here.get_disks()) servers.push_back({&here, disk, {}, {}});
    if (!servers.empty()) return servers;
  }
  for (s4u::Host* host : s4u::Engine::get_instance()->get_all_hosts()) {
    if (!has_property(*host, "serves", "common")) continue;
    for (s4u::Disk* disk : host->get_disks()) {
      servers.push_back({host, disk, wire_between(*host, here), wire_between(here, *host)});
    }
  }
  if (servers.empty()) {
    throw InputError("platform", "hosts", "no host with a disk has the property serves=\"common\"",
                     "name the NFS server as platforms/README.md shows");
  }
  return servers;
}

/// 0 = not told.
std::uint64_t memory_of(const s4u::Host& host) {
  const char* memory = host.get_property("memory");
  return memory == nullptr
             ? 0
             : parse_bytes(memory, "platform", "host " + host.get_name() + ": memory");
}

class SimulatedMachine final : public Machine {
 public:
  explicit SimulatedMachine(const CostModel& costs)
      : costs_(costs), here_(s4u::this_actor::get_host()) {
    // All hosts and disks, so that every rank refuses the same platform.
    for (s4u::Host* host : s4u::Engine::get_instance()->get_all_hosts()) {
      refuse_misspelt(*host);
      for (s4u::Disk* disk : host->get_disks()) arm_of(*disk, costs_.disk);
      memory_of(*host);
    }
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
    ahead_s_ += 1e-6 * std::min(turn + 1, 1000);
    settle();
  }
  bool simulated() const override { return true; }
  std::string host() const override { return here_->get_name(); }

 private:
  static void execute(double flops) {
    if (flops > 0.0) smpi_execute_flops(flops);
  }
  /// Turning bytes into records or back: a rank with a core of its own, at its usual speed, knows
  /// how long that takes. The simulation hears of it with the next request, which saves it an
  /// event.
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
  /// What counts for nothing lies, in the modelled program, in a file that is charged elsewhere.
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
    // All who ask a disk from elsewhere are as late by what a request costs, so that whose request
    // is first is known now (but for what one rank decodes before it asks again).
    const double come_s = now_s() + (remote ? arm.request_s : 0.0);
    // The transfer has the disk's whole bandwidth: what SimGrid's own disk activity would take,
    // without its record of every activity ever made, which each later one has to search.
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
  double ahead_s_ = 0.0;  ///< that this rank is later than the simulation knows
};

}  // namespace

bool machines_are_simulated() { return true; }

std::unique_ptr<Machine> make_machine(const std::string& cost_model_file) {
  // Only what is charged counts, whatever smpirun's command line said; and looking for a message is
  // as cheap as it is on a real machine.
  xbt_log_control_set("xbt_cfg.thres:warning");
  s4u::Engine::set_config("smpi/simulate-computation:no");
  s4u::Engine::set_config("smpi/test:0");
  s4u::Engine::set_config("smpi/iprobe:0");
  s4u::Engine::set_config("smpi/grow-injected-times:no");
  return std::make_unique<SimulatedMachine>(
      cost_model_file.empty() ? CostModel{} : read_cost_model(cost_model_file));
}

}  // namespace enfilade
