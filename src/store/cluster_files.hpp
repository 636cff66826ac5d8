// A rank's way to the clusters' sections, wherever they lie: on a disk (ClusterStore), or with a
// master (schemes/master/remote_files.hpp).
#pragma once

#include <span>

#include "run/section_file.hpp"

namespace enfilade {

/// One section of one cluster.
struct SectionName {
  ClusterId cluster;
  Section section = Section::geometry;
  bool committed = false;  ///< patches only: as the last iteration committed them, not the newest
  constexpr auto operator<=>(const SectionName&) const = default;
};

/// While iteration k is under way, others' clusters are read as iteration k-1 committed them, and
/// those that count as written, as they are now.
class ClusterFiles {
 public:
  virtual ~ClusterFiles() = default;
  /// From now on `iteration` is the committed one.
  virtual void set_committed(int iteration) = 0;
  virtual int committed() const = 0;
  /// What is about to be read, so that it can come all at once.
  virtual void announce(std::span<const SectionName>) {}

  virtual SectionFile read_geometry(ClusterId id) = 0;
  /// The newest patches that this rank may see.
  virtual SectionFile read_patches(ClusterId id) = 0;
  /// As the last iteration committed them, whatever was written since.
  virtual SectionFile read_committed_patches(ClusterId id) = 0;
  /// The links that go with them; read_patches() or write() of this cluster must have come before.
  virtual SectionFile read_links(ClusterId id) = 0;

  /// What a gather made of the cluster; `links` empty = as they were.
  virtual void write(ClusterId id, std::span<const std::byte> patches,
                     const RecordCount& patches_count, std::span<const std::byte> links,
                     const RecordCount& links_count) = 0;
  /// Has the cluster been gathered for in this iteration, as far as this rank may see?
  virtual bool written(ClusterId id) const = 0;
  /// MoveToCommonDirectory of figure 2: all that was written in this iteration.
  virtual void move_to_common() = 0;
};

}  // namespace enfilade
