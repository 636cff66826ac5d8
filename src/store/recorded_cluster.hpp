// A cluster without its content: only how much its sections hold. A replay keeps it in memory in
// place of the light, so that the same memory budget and the same rules of eviction apply to it.
#pragma once

#include <cstdint>

#include "base/ids.hpp"

namespace enfilade {

/// How much one section holds.
struct SectionWeight {
  std::uint64_t count = 0;         ///< of surfaces, patches or links
  std::uint64_t file_bytes = 0;    ///< without the file's header
  std::uint64_t memory_bytes = 0;  ///< geometry counts with the patches
};

struct ClusterWeight {
  SectionWeight geometry, patches, links;
};

/// Stands where a ClusterState stands in ResidentClusters.
class RecordedCluster {
 public:
  RecordedCluster(ClusterId id, const ClusterWeight& weight) : id_(id), weight_(weight) {}

  ClusterId id() const { return id_; }
  const ClusterWeight& weight() const { return weight_; }
  RecordedCluster shooter() const { return {id_, {weight_.geometry, weight_.patches, {}}}; }
  void set_patches(const SectionWeight& patches) { weight_.patches = patches; }
  void set_links(const SectionWeight& links) { weight_.links = links; }

 private:
  ClusterId id_;
  ClusterWeight weight_;
};

}  // namespace enfilade
