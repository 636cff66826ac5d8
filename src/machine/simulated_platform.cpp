#include "machine/simulated_platform.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>

#include "base/error.hpp"
#include "base/nearest_word.hpp"

namespace enfilade {

namespace s4u = simgrid::s4u;

namespace {

/// The disk's own property `key`, or the cost model's value.
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

/// Refuses a property whose name is nearly one of `ours`, or is one of `others`, which belong
/// elsewhere. Any other that is not ours may be another program's.
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

bool has_property(const s4u::Host& host, const char* key, const char* value) {
  const char* is = host.get_property(key);
  return is != nullptr && std::string(is) == value;
}

}  // namespace

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

double Wire::transfer_s(std::uint64_t bytes) const {
  double bandwidth = std::numeric_limits<double>::infinity();
  for (const s4u::Link* link : links) bandwidth = std::min(bandwidth, link->get_bandwidth());
  return static_cast<double>(bytes) / bandwidth;
}

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

std::uint64_t memory_of(const s4u::Host& host) {
  const char* memory = host.get_property("memory");
  return memory == nullptr
             ? 0
             : parse_bytes(memory, "platform", "host " + host.get_name() + ": memory");
}

void check_platform(const DiskCosts& costs) {
  for (s4u::Host* host : s4u::Engine::get_instance()->get_all_hosts()) {
    refuse_misspelt(*host);
    for (s4u::Disk* disk : host->get_disks()) arm_of(*disk, costs);
    memory_of(*host);
  }
}

}  // namespace enfilade
