// Clusters as bytes of their sections, wherever these lie: on a disk (ClusterStore) or with a
// master (schemes/master/remote_files.hpp). Encodes and decodes.
#pragma once

#include <compare>
#include <vector>

#include "run/sections/section_file.hpp"
#include "store/cluster_source.hpp"

namespace enfilade {

/// One section of one cluster.
struct SectionName {
  ClusterId cluster;
  Section section = Section::geometry;
  bool committed = false;  ///< patches only: as the last iteration committed them, not the newest
  constexpr auto operator<=>(const SectionName&) const = default;
};

class ClusterFiles : public ClusterSource<ClusterState> {
 public:
  void announce(std::span<const ShooterRequest> shooters) final;
  std::unique_ptr<ClusterState> read_shooter(ClusterId id, Light light,
                                             const ClusterState* known) final;
  void read_links(ClusterState& cluster) final;
  SectionBytes write(const ClusterState& cluster, bool links_changed) final;

  /// Links are those that go with the newest patches: load_section() of these patches, or
  /// store_sections() of this cluster, must have come before.
  virtual SectionFile load_section(const SectionName& name) = 0;
  /// Stores the sections of one cluster: its patches and, where they changed, its links. The
  /// iteration that writes them and the links' slot are set here.
  virtual void store_sections(std::vector<SectionFile> sections) = 0;
  /// Announces the sections that load_section() will be called for, in this order.
  virtual void prefetch(std::vector<SectionName>) {}

 private:
  SectionName patches_of(ClusterId id, Light light) const;
};

}  // namespace enfilade
