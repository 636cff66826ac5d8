#include "run/sections/section_file.hpp"

#include <array>

#include "base/byte_stream.hpp"
#include "base/checksum.hpp"
#include "base/error.hpp"
#include "base/posix_file.hpp"

namespace enfilade {
namespace {

constexpr std::array<char, 8> mark = {'E', 'N', 'F', 'C', 'L', 'U', 'S', '\n'};
constexpr std::uint32_t version = 9;  // 8: settled shares; 9: errors of links

/// The header without its own checksum.
constexpr std::size_t summed_bytes =
    mark.size() + sizeof version + section_info_bytes + sizeof(std::uint64_t);
constexpr std::size_t header_bytes = summed_bytes + sizeof(std::uint64_t);

struct Header {
  SectionInfo info;
  std::uint64_t body_checksum = 0;
};

/// Of the file at `path`, whose first bytes are these.
Header header_from(std::span<const std::byte> bytes, const std::string& path) {
  if (bytes.size() < header_bytes) refuse_damaged(path, "the file is cut short");
  ByteReader r(bytes.first(header_bytes), path);
  if (r.get<std::array<char, mark.size()>>() != mark) refuse_damaged(path, "not a cluster's file");
  const auto file_version = r.get<std::uint32_t>();
  if (file_version != version)
    refuse_damaged(path, "version " + std::to_string(file_version) + " is not known");
  Header h;
  h.info = get_info(r);
  h.body_checksum = r.get<std::uint64_t>();
  if (r.get<std::uint64_t>() != checksum(bytes.first(summed_bytes)))
    refuse_damaged(path, "the header is damaged (checksum)");
  return h;
}

}  // namespace

void refuse_damaged(const std::string& path, const std::string& what) {
  throw RunError(path + ": " + what + "; solve again without --resume");
}

void put_links(ByteWriter& w, const LinksPlace& links) {
  w.put(links.iteration);
  w.put(links.at.rank.value);
  w.put(links.at.part);
  w.put(links.at.offset);
}

LinksPlace get_links(ByteReader& r) {
  LinksPlace links;
  links.iteration = r.get<std::uint32_t>();
  links.at.rank = Rank{r.get<decltype(links.at.rank.value)>()};
  links.at.part = r.get<std::uint32_t>();
  links.at.offset = r.get<std::uint64_t>();
  return links;
}

void put_info(ByteWriter& w, const SectionInfo& info) {
  w.put(info.place.cluster);
  w.put(info.place.section);
  w.put(info.place.iteration);
  w.put(info.place.run);
  put_links(w, info.links);
  w.put(info.count.surfaces);
  w.put(info.count.patches);
  w.put(info.count.links);
  w.put(info.count.bytes);
}

SectionInfo get_info(ByteReader& r) {
  SectionInfo info;
  info.place.cluster = r.get<ClusterId>();
  info.place.section = r.get<Section>();
  info.place.iteration = r.get<std::uint32_t>();
  info.place.run = r.get<std::uint64_t>();
  info.links = get_links(r);
  info.count.surfaces = r.get<std::uint64_t>();
  info.count.patches = r.get<std::uint64_t>();
  info.count.links = r.get<std::uint64_t>();
  info.count.bytes = r.get<std::uint64_t>();
  return info;
}

std::vector<std::byte> section_header(const SectionInfo& info, std::span<const std::byte> bytes) {
  SectionInfo sized = info;
  sized.count.bytes = bytes.size();
  ByteWriter w(header_bytes);
  w.put(mark);
  w.put(version);
  put_info(w, sized);
  w.put(checksum(bytes));
  w.put(checksum(w.bytes()));
  return w.take();
}

SectionFile read_section(const std::string& path, std::uint64_t offset, const SectionPlace& place) {
  const Header h = header_from(read_part(path, offset, header_bytes), path);
  const SectionPlace& found = h.info.place;
  if (found.cluster != place.cluster || found.section != place.section)
    refuse_damaged(path, "belongs to another cluster or section");
  if (found.run != place.run) refuse_damaged(path, "belongs to another run");
  if (found.iteration != place.iteration) {
    refuse_damaged(path, "is of iteration " + std::to_string(found.iteration) + ", not of " +
                             std::to_string(place.iteration));
  }
  std::vector<std::byte> bytes = read_part(path, offset + header_bytes, h.info.count.bytes);
  if (bytes.size() < h.info.count.bytes) refuse_damaged(path, "the file is cut short");
  if (h.body_checksum != checksum(bytes)) refuse_damaged(path, "the content is damaged (checksum)");
  return {h.info, std::move(bytes)};
}

}  // namespace enfilade
