#include "store/recorded_cluster.hpp"

#include "base/byte_stream.hpp"

namespace enfilade {
namespace {

SectionWeight weight_in(std::span<const std::byte> bytes, ClusterId& id) {
  ByteReader reader(bytes, "a recorded section");
  id = reader.get<ClusterId>();
  const auto weight = reader.get<SectionWeight>();
  reader.expect_end();
  return weight;
}

}  // namespace

RecordedCluster::RecordedCluster(std::span<const std::byte> geometry,
                                 std::span<const std::byte> patches,
                                 std::span<const std::byte> links) {
  weight_.geometry = weight_in(geometry, id_);
  weight_.patches = weight_in(patches, id_);
  if (!links.empty()) weight_.links = weight_in(links, id_);
}

std::vector<std::byte> RecordedCluster::section_bytes(ClusterId id, const SectionWeight& weight) {
  ByteWriter writer;
  writer.put(id);
  writer.put(weight);
  return writer.take();
}

std::vector<std::byte> RecordedCluster::bytes_of(Section section) const {
  if (section == Section::geometry) return section_bytes(id_, weight_.geometry);
  return section_bytes(id_, section == Section::patches ? weight_.patches : weight_.links);
}

void RecordedCluster::become(const SectionWeight& patches, const SectionWeight& links) {
  weight_.patches = patches;
  weight_.links = links;
}

}  // namespace enfilade
