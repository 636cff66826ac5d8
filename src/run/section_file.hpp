// The file of one section of one cluster: a header with a version and checksums, then the section's
// bytes (§4.1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/byte_stream.hpp"
#include "base/ids.hpp"
#include "hierarchy/cluster_state.hpp"
#include "machine/machine.hpp"
#include "run/run_layout.hpp"

namespace enfilade {

/// What the header of a section's file says about the section.
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

/// The info as bytes: cluster u32, section u8, slot of the links u8, iteration u32, surfaces u64,
/// patches u64, links u64, bytes u64.
void put_info(ByteWriter& writer, const SectionInfo& info);
SectionInfo get_info(ByteReader& reader);
constexpr std::size_t section_info_bytes =
    2 * sizeof(std::uint32_t) + 2 + 4 * sizeof(std::uint64_t);

/// The file, little-endian and without padding: "ENFCLUS\n", version u32, the info, XXH64 of the
/// section's bytes u64, XXH64 of the header so far u64; then the bytes. `info.count.bytes` is taken
/// from `bytes`. Throws RunError.
void write_section(const std::string& path, const SectionInfo& info,
                   std::span<const std::byte> bytes);
/// Throws RunError for a file that is missing, cut short, damaged (XXH64), of another version, or
/// of another cluster or section than asked for.
SectionFile read_section(const std::string& path, ClusterId cluster, Section section);
/// Returns XXH64 of the bytes, as the files carry it.
std::uint64_t checksum(std::span<const std::byte> bytes);

}  // namespace enfilade
