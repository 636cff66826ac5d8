// The simulated platform, as its XML file gives it (platforms/README.md): disks with their arms,
// wires between hosts, memory. This and smpi.cpp are the only files that name SimGrid.
#pragma once

#include <simgrid/s4u.hpp>

#include <cstdint>
#include <vector>

#include "machine/background_load.hpp"
#include "machine/cost_model.hpp"

namespace enfilade {

/// The arm of a disk serves one request at a time, first come, first served. All ranks share one
/// address space, so the arm is stored with SimGrid's disk, where every rank finds it. The end of a
/// request is known when it comes, since the requests before it have said how long they take.
struct DiskArm {
  double free_s = 0.0;  ///< when the requests so far are done
  double seek_s = 0.0;
  double request_s = 0.0;  ///< what a request costs a client on another host
  BackgroundLoad others;   ///< what other programs take of the disk
};

/// Returns the arm of this disk, made by the first rank that asks; it lives as long as the
/// simulation. Throws InputError for a disk without bandwidth or with a bad property.
DiskArm& arm_of(simgrid::s4u::Disk& disk, const DiskCosts& costs);

/// The route of bytes from one host to another.
struct Wire {
  std::vector<simgrid::s4u::Link*> links;
  double latency_s = 0.0;

  double transfer_s(std::uint64_t bytes) const;  ///< by the slowest of the links, without latency
};

/// A disk and the host that it hangs on, and the wires from and to a rank's host.
struct Server {
  simgrid::s4u::Host* host = nullptr;
  simgrid::s4u::Disk* disk = nullptr;
  Wire from, to;
};

/// Returns the disks that hold the common directory, for a rank on the host `here`: those of hosts
/// with serves="common", or its own where it is alone and its host has serves="alone". Throws
/// InputError where there are none or no route leads to one.
std::vector<Server> common_servers(simgrid::s4u::Host& here);

/// Returns the host's property `memory`, in bytes; 0 where it has none.
std::uint64_t memory_of(const simgrid::s4u::Host& host);

/// Reads the properties of all hosts and disks, so that every rank refuses the same platform.
/// Throws InputError for a property that is misspelt, misplaced or has a bad value.
void check_platform(const DiskCosts& costs);

}  // namespace enfilade
