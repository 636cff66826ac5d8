#include "run/section_file.hpp"

#include <array>

#include "base/byte_stream.hpp"
#include "base/checksum.hpp"
#include "base/error.hpp"
#include "base/posix_file.hpp"

namespace enfilade {
namespace {

constexpr std::array<char, 8> mark = {'E', 'N', 'F', 'C', 'L', 'U', 'S', '\n'};
constexpr std::uint32_t version = 6;  // 5: tints, lead bands; 6: kept light

/// The header without its own checksum.
constexpr std::size_t summed_bytes =
    mark.size() + sizeof version + section_info_bytes + sizeof(std::uint64_t);
constexpr std::size_t header_bytes = summed_bytes + sizeof(std::uint64_t);

struct Header {
  SectionInfo info;
  std::uint64_t body_checksum = 0;
};

std::vector<std::byte> bytes_of(const Header& h) {
  ByteWriter w(header_bytes);
  w.put(mark);
  w.put(version);
  put_info(w, h.info);
  w.put(h.body_checksum);
  w.put(checksum(w.bytes()));
  return w.take();
}

[[noreturn]] void damaged(const std::string& path, const std::string& what) {
  throw RunError(path + ": " + what + "; solve again without --resume");
}

/// Of the file at `path`, whose first bytes are these.
Header header_from(std::span<const std::byte> bytes, const std::string& path) {
  if (bytes.size() < header_bytes) damaged(path, "the file is cut short");
  ByteReader r(bytes.first(header_bytes), path);
  if (r.get<std::array<char, mark.size()>>() != mark) damaged(path, "not a cluster's file");
  const auto file_version = r.get<std::uint32_t>();
  if (file_version != version)
    damaged(path, "version " + std::to_string(file_version) + " is not known");
  Header h;
  h.info = get_info(r);
  h.body_checksum = r.get<std::uint64_t>();
  if (r.get<std::uint64_t>() != checksum(bytes.first(summed_bytes)))
    damaged(path, "the header is damaged (checksum)");
  return h;
}

}  // namespace

void put_info(ByteWriter& w, const SectionInfo& info) {
  w.put(info.place.cluster);
  w.put(info.place.section);
  w.put(info.links.slot);
  w.put(info.place.iteration);
  w.put(info.place.run);
  w.put(info.links.iteration);
  w.put(info.count.surfaces);
  w.put(info.count.patches);
  w.put(info.count.links);
  w.put(info.count.bytes);
}

SectionInfo get_info(ByteReader& r) {
  SectionInfo info;
  info.place.cluster = r.get<ClusterId>();
  info.place.section = r.get<Section>();
  info.links.slot = r.get<Slot>();
  info.place.iteration = r.get<std::uint32_t>();
  info.place.run = r.get<std::uint64_t>();
  info.links.iteration = r.get<std::uint32_t>();
  info.count.surfaces = r.get<std::uint64_t>();
  info.count.patches = r.get<std::uint64_t>();
  info.count.links = r.get<std::uint64_t>();
  info.count.bytes = r.get<std::uint64_t>();
  return info;
}

void write_section(const std::string& path, const SectionInfo& info,
                   std::span<const std::byte> bytes) {
  Header h{info, checksum(bytes)};
  h.info.count.bytes = bytes.size();
  write_file(path, bytes_of(h), bytes);
}

SectionFile read_section(const std::string& path, const SectionPlace& place) {
  std::vector<std::byte> all = read_file(path);
  const Header h = header_from(all, path);
  const SectionPlace& found = h.info.place;
  if (found.cluster != place.cluster || found.section != place.section)
    damaged(path, "belongs to another cluster or section");
  if (found.run != place.run) damaged(path, "belongs to another run");
  if (found.iteration != place.iteration) {
    damaged(path, "is of iteration " + std::to_string(found.iteration) + ", not of " +
                      std::to_string(place.iteration));
  }
  if (h.info.count.bytes != all.size() - header_bytes) damaged(path, "the file is cut short");
  all.erase(all.begin(), all.begin() + header_bytes);
  if (h.body_checksum != checksum(all)) damaged(path, "the content is damaged (checksum)");
  return {h.info, std::move(all)};
}

}  // namespace enfilade
