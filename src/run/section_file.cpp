#include "run/section_file.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cstring>

#include "base/error.hpp"
#include "base/posix_file.hpp"

namespace enfilade {
namespace {

constexpr std::array<char, 8> magic = {'E', 'N', 'F', 'C', 'L', 'U', 'S', '\n'};
constexpr std::uint32_t version = 2;  // 2: links without padding (cluster_codec.hpp)

/// As it lies in the file, in the byte order of the machine.
struct Header {
  std::array<char, 8> magic_word;
  std::uint32_t file_version;
  std::uint32_t cluster;
  std::uint32_t section;
  std::uint32_t iteration;
  std::uint32_t links_slot;
  std::uint32_t spare;
  std::uint64_t surfaces, patches, links, bytes;
  std::uint64_t body_checksum;
  std::uint64_t header_checksum;  ///< of all the above
};
static_assert(sizeof(Header) == 80);

std::uint64_t header_checksum(const Header& h) {
  return XXH64(&h, offsetof(Header, header_checksum), 0);
}

[[noreturn]] void damaged(const std::string& path, const std::string& what) {
  throw RunError(path + ": " + what + "; solve again without --resume");
}

}  // namespace

std::uint64_t checksum(std::span<const std::byte> bytes) {
  return XXH64(bytes.data(), bytes.size(), 0);
}

void write_section(const std::string& path, const SectionInfo& info,
                   std::span<const std::byte> bytes) {
  Header h{};
  h.magic_word = magic;
  h.file_version = version;
  h.cluster = info.cluster.value;
  h.section = static_cast<std::uint32_t>(info.section);
  h.iteration = info.iteration;
  h.links_slot = static_cast<std::uint32_t>(info.links_slot);
  h.surfaces = info.count.surfaces;
  h.patches = info.count.patches;
  h.links = info.count.links;
  h.bytes = bytes.size();
  h.body_checksum = checksum(bytes);
  h.header_checksum = header_checksum(h);
  write_file(path, std::as_bytes(std::span(&h, 1)), bytes);
}

SectionFile read_section(const std::string& path, ClusterId cluster, Section section) {
  std::vector<std::byte> all = read_file(path);
  Header h{};
  if (all.size() < sizeof h) damaged(path, "the file is cut short");
  std::memcpy(&h, all.data(), sizeof h);
  if (h.magic_word != magic) damaged(path, "not a cluster's file");
  if (h.file_version != version)
    damaged(path, "version " + std::to_string(h.file_version) + " is not known");
  if (h.header_checksum != header_checksum(h)) damaged(path, "the header is damaged (checksum)");
  if (h.cluster != cluster.value || h.section != static_cast<std::uint32_t>(section)) {
    damaged(path, "belongs to another cluster or section");
  }
  if (h.bytes != all.size() - sizeof h) damaged(path, "the file is cut short");
  all.erase(all.begin(), all.begin() + sizeof h);
  if (h.body_checksum != checksum(all)) damaged(path, "the content is damaged (checksum)");

  SectionFile file;
  file.info.cluster = cluster;
  file.info.section = section;
  file.info.iteration = h.iteration;
  file.info.links_slot = h.links_slot == 0 ? Slot::a : Slot::b;
  file.info.count = {h.surfaces, h.patches, h.links, h.bytes};
  file.bytes = std::move(all);
  return file;
}

}  // namespace enfilade
