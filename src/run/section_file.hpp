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

/// Which links go with the patches of a cluster: their slot, and the iteration that wrote them.
struct LinksPlace {
  Slot slot = Slot::a;
  std::uint32_t iteration = 0;
};

/// Where a section belongs. A file that is elsewhere, of another run or of another iteration, is
/// refused, whole as it may be.
struct SectionPlace {
  ClusterId cluster;
  Section section = Section::geometry;
  std::uint32_t iteration = 0;  ///< that wrote it; 0 = before the first
  std::uint64_t run = 0;        ///< Manifest::run
  bool operator==(const SectionPlace&) const = default;
};

/// What the header of a section's file says about the section.
struct SectionInfo {
  SectionPlace place;
  LinksPlace links;   ///< patches only
  RecordCount count;  ///< surfaces, patches, links; bytes = those of the section
};

struct SectionFile {
  SectionInfo info;
  std::vector<std::byte> bytes;
};

/// The info as bytes: cluster u32, section u8, slot of the links u8, iteration u32, run u64,
/// iteration of the links u32, surfaces u64, patches u64, links u64, bytes u64.
void put_info(ByteWriter& writer, const SectionInfo& info);
SectionInfo get_info(ByteReader& reader);
constexpr std::size_t section_info_bytes =
    3 * sizeof(std::uint32_t) + 2 + 5 * sizeof(std::uint64_t);

/// The file, little-endian and without padding: "ENFCLUS\n", version u32, the info, XXH64 of the
/// section's bytes u64, XXH64 of the header so far u64; then the bytes. `info.count.bytes` is taken
/// from `bytes`. Throws RunError.
void write_section(const std::string& path, const SectionInfo& info,
                   std::span<const std::byte> bytes);
/// Throws RunError for a file that is missing, cut short, damaged (XXH64), of another version, or
/// of another place than asked for.
SectionFile read_section(const std::string& path, const SectionPlace& place);

}  // namespace enfilade
