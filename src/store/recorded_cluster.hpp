// A cluster without its content: only what its sections weigh. What a replay keeps in memory in
// place of the light, so that the same store and the same rules of eviction work on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.hpp"
#include "hierarchy/cluster_state.hpp"

namespace enfilade {

/// Of one section: how many surfaces, patches or links, and what they take.
struct SectionWeight {
  std::uint64_t count = 0;
  std::uint64_t file_bytes = 0;    ///< without the file's header
  std::uint64_t memory_bytes = 0;  ///< geometry counts with the patches
  std::uint64_t version = 0;       ///< of links: another one wherever their content is another
};

struct ClusterWeight {
  SectionWeight geometry, patches, links;
};

/// Stands where a ClusterState stands in ResidentClusters; its sections' bytes are their weights.
class RecordedCluster {
 public:
  RecordedCluster(ClusterId id, const ClusterWeight& weight) : id_(id), weight_(weight) {}
  /// From its sections; `links` may be empty. Throws RunError where they are none.
  RecordedCluster(std::span<const std::byte> geometry, std::span<const std::byte> patches,
                  std::span<const std::byte> links);

  ClusterId id() const { return id_; }
  std::vector<std::byte> bytes_of(Section section) const;
  RecordedCluster shooter() const { return {id_, {weight_.geometry, weight_.patches, {}}}; }
  const ClusterWeight& weight() const { return weight_; }
  /// What its gather made of it.
  void become(const SectionWeight& patches, const SectionWeight& links);
  void drop_links() { weight_.links = {}; }

  /// The bytes that a shelf gives for a section of this weight.
  static std::vector<std::byte> section_bytes(ClusterId id, const SectionWeight& weight);

 private:
  ClusterId id_;
  ClusterWeight weight_;
};

}  // namespace enfilade
