// The file of one section of one cluster: a header with a version and a checksum, then the bytes
// (§4.1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/ids.hpp"
#include "hierarchy/cluster_state.hpp"
#include "machine/machine.hpp"
#include "run/run_layout.hpp"

namespace enfilade {

/// What a section's file says about it.
struct SectionInfo {
  ClusterId cluster;
  Section section = Section::geometry;
  std::uint32_t iteration = 0;  ///< that wrote it
  Slot links_slot = Slot::a;    ///< patches only: where the links that go with them lie
  RecordCount count;            ///< surfaces, patches, links; bytes = those of the section
};

struct SectionFile {
  SectionInfo info;
  std::vector<std::byte> bytes;
};

void write_section(const std::string& path, const SectionInfo& info,
                   std::span<const std::byte> bytes);
/// Throws RunError for a file that is missing, cut short, damaged (XXH64), of another version, or
/// of another cluster or section than asked for.
SectionFile read_section(const std::string& path, ClusterId cluster, Section section);
/// XXH64 of the bytes, as the files carry it.
std::uint64_t checksum(std::span<const std::byte> bytes);

}  // namespace enfilade
