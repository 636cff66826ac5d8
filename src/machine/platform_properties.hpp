// What a platform's file says of hosts and disks beside SimGrid's own (platforms/README.md): their
// <prop> elements.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>

#include "machine/background_load.hpp"

namespace enfilade {

using PlatformProperties = std::unordered_map<std::string, std::string>;

/// Which common directory a host's disks hold: none, that of all ranks, or its own where the only
/// rank runs on it.
enum class Serves { nobody, common, alone };

struct HostProperties {
  std::uint64_t memory_bytes = 0;  ///< 0: not told
  Serves serves = Serves::nobody;
};

struct DiskProperties {
  std::optional<double> seek_s, request_s;  ///< finite, from 0 up
  BackgroundLoad background;
};

/// Read the properties of a host or disk of this name. Both throw InputError for one that is
/// misspelt, belongs elsewhere or has a bad value. Others may be another program's.
HostProperties host_properties(const std::string& host, const PlatformProperties& properties);
DiskProperties disk_properties(const std::string& disk, const PlatformProperties& properties);

}  // namespace enfilade
