#include "machine/simulated_platform.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <string>

#include "base/error.hpp"
#include "machine/platform_properties.hpp"

namespace enfilade {

namespace s4u = simgrid::s4u;

namespace {

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

bool serves(const s4u::Host& host, Serves what) {
  return host_properties(host.get_name(), *host.get_properties()).serves == what;
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
    const DiskProperties own = disk_properties(disk.get_name(), *disk.get_properties());
    arm->seek_s = own.seek_s.value_or(costs.seek_s);
    arm->request_s = own.request_s.value_or(costs.request_s);
    arm->others = own.background;
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
  if (alone && serves(here, Serves::alone)) {
    for (s4u::Disk* disk : here.get_disks()) servers.push_back({&here, disk, {}, {}});
    if (!servers.empty()) return servers;
  }
  for (s4u::Host* host : s4u::Engine::get_instance()->get_all_hosts()) {
    if (!serves(*host, Serves::common)) continue;
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
  return host_properties(host.get_name(), *host.get_properties()).memory_bytes;
}

void check_platform(const DiskCosts& costs) {
  for (s4u::Host* host : s4u::Engine::get_instance()->get_all_hosts()) {
    host_properties(host->get_name(), *host->get_properties());
    for (s4u::Disk* disk : host->get_disks()) arm_of(*disk, costs);
  }
}

}  // namespace enfilade
