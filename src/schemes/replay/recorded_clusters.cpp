#include "schemes/replay/recorded_clusters.hpp"

namespace enfilade {
namespace {

RecordCount count_of(Section section, const SectionWeight& weight) {
  RecordCount count;
  count.bytes = weight.file_bytes;
  switch (section) {
    case Section::geometry:
      count.surfaces = weight.count;
      break;
    case Section::patches:
      count.patches = weight.count;
      break;
    case Section::links:
      count.links = weight.count;
      break;
  }
  return count;
}

}  // namespace

void RecordedClusters::read(ClusterId id, Section section, const SectionWeight& weight,
                            bool local) {
  charges_.read(local ? Disk::local : Disk::common, id, count_of(section, weight));
}

std::unique_ptr<RecordedCluster> RecordedClusters::read_shooter(ClusterId id, Light light,
                                                                const RecordedCluster* known) {
  const bool local = light == Light::newest && written(id);
  ClusterWeight now = weight(id, local);
  if (known == nullptr) read(id, Section::geometry, now.geometry, false);
  read(id, Section::patches, now.patches, local);
  now.links = {};
  return std::make_unique<RecordedCluster>(id, now);
}

void RecordedClusters::read_links(RecordedCluster& cluster) {
  const bool local = charges_.links_written(cluster.id());
  const SectionWeight links = weight(cluster.id(), local).links;
  read(cluster.id(), Section::links, links, local);
  cluster.set_links(links);
}

SectionBytes RecordedClusters::write(const RecordedCluster& cluster, bool links_changed) {
  const ClusterWeight& now = cluster.weight();
  if (links_changed)
    charges_.write(cluster.id(), Section::links, count_of(Section::links, now.links));
  charges_.write(cluster.id(), Section::patches, count_of(Section::patches, now.patches));
  return {now.patches.file_bytes, links_changed ? now.links.file_bytes : 0};
}

}  // namespace enfilade
