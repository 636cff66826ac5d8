// One section of one cluster in a file: a header with a version and checksums, then the section's
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

namespace enfilade {

/// Where a section lies among the segments of one kind (segment_file.hpp): whose, in which part,
/// and from which byte on.
struct SegmentPlace {
  Rank rank{0};
  std::uint32_t part = 0;
  std::uint64_t offset = 0;
  bool operator==(const SegmentPlace&) const = default;
};

/// Which links go with the patches of a cluster: the iteration that wrote them, and where.
struct LinksPlace {
  std::uint32_t iteration = 0;
  SegmentPlace at;
  bool operator==(const LinksPlace&) const = default;
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

/// The info as bytes: cluster u32, section u8, iteration u32, run u64, the place of the links
/// (iteration u32, rank u32, part u32, offset u64), surfaces u64, patches u64, links u64, bytes
/// u64.
void put_info(ByteWriter& writer, const SectionInfo& info);
SectionInfo get_info(ByteReader& reader);
void put_links(ByteWriter& writer, const LinksPlace& links);
LinksPlace get_links(ByteReader& reader);
constexpr std::size_t links_place_bytes = 3 * sizeof(std::uint32_t) + sizeof(std::uint64_t);
constexpr std::size_t section_info_bytes =
    2 * sizeof(std::uint32_t) + 1 + links_place_bytes + 5 * sizeof(std::uint64_t);

/// Throws RunError: what is wrong with a file of a solution, and what to do.
[[noreturn]] void refuse_damaged(const std::string& path, const std::string& what);

/// Returns what stands in front of a section's bytes, little-endian and without padding:
/// "ENFCLUS\n", version u32, the info, XXH64 of the section's bytes u64, XXH64 of the header so far
/// u64. `info.count.bytes` is taken from `bytes`.
std::vector<std::byte> section_header(const SectionInfo& info, std::span<const std::byte> bytes);
/// Reads the section that begins at a byte of a file. Throws RunError where it is missing, cut
/// short, damaged (XXH64), of another version, or of another place than asked for.
SectionFile read_section(const std::string& path, std::uint64_t offset, const SectionPlace& place);

}  // namespace enfilade
