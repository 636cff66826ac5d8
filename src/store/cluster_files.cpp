#include "store/cluster_files.hpp"

#include "hierarchy/cluster_codec.hpp"

namespace enfilade {

SectionName ClusterFiles::patches_of(ClusterId id, Light light) const {
  return {id, Section::patches, light == Light::committed || !written(id)};
}

void ClusterFiles::announce(std::span<const ShooterRequest> shooters) {
  std::vector<SectionName> names;
  for (const ShooterRequest& shooter : shooters) {
    if (!shooter.geometry_known) names.push_back({shooter.cluster, Section::geometry});
    names.push_back(patches_of(shooter.cluster, shooter.light));
  }
  prefetch(std::move(names));
}

std::unique_ptr<ClusterState> ClusterFiles::read_shooter(ClusterId id, Light light,
                                                         const ClusterState* known) {
  const std::vector<std::byte> geometry = known != nullptr
                                              ? known->bytes_of(Section::geometry)
                                              : load_section({id, Section::geometry}).bytes;
  const SectionFile patches = load_section(patches_of(id, light));
  return std::make_unique<ClusterState>(geometry, patches.bytes, std::span<const std::byte>());
}

void ClusterFiles::read_links(ClusterState& cluster) {
  const SectionFile links = load_section({cluster.id(), Section::links});
  ByteReader reader(links.bytes, "a cluster's record");
  cluster.links() = ClusterCodec::read_links(reader, cluster.links().stride());
  reader.expect_end();
}

SectionBytes ClusterFiles::write(const ClusterState& cluster, bool links_changed) {
  std::vector<SectionFile> sections;
  const auto add = [&](Section section, RecordCount count) {
    std::vector<std::byte> bytes = cluster.bytes_of(section);
    count.bytes = bytes.size();
    sections.push_back({{{cluster.id(), section}, {}, count}, std::move(bytes)});
  };
  add(Section::patches, {0, cluster.patches().size(), 0, 0});
  if (links_changed) add(Section::links, {0, 0, cluster.links().size(), 0});
  const SectionBytes written{sections.front().bytes.size(),
                             links_changed ? sections.back().bytes.size() : 0};
  store_sections(std::move(sections));
  return written;
}

}  // namespace enfilade
