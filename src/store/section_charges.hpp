// What a rank reads, writes and moves of the clusters' sections (§4.1): charged to its machine and
// counted, whether the sections are files (ClusterStore) or only figures of a recorded run
// (schemes/replay/recorded_clusters.hpp).
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "hierarchy/cluster_state.hpp"
#include "machine/machine.hpp"

namespace enfilade {

/// Bytes and files that this rank moved, at the size that the machine counts them for.
struct StoreCount {
  std::uint64_t bytes_read = 0, bytes_written = 0;
  std::uint64_t files_read = 0, files_written = 0;
};

class SectionCharges {
 public:
  SectionCharges(Machine& machine, std::size_t clusters) : machine_(machine), written_(clusters) {}

  void read(Disk disk, ClusterId id, const RecordCount& count);
  /// Charges writing patches or links into the local directory. Patches come last.
  void write(ClusterId id, Section section, const RecordCount& count);
  /// True where the cluster's patches have been written since the last move_to_common().
  bool written(ClusterId id) const { return written_[id.index()] != 0; }
  /// True where its links have been written since then.
  bool links_written(ClusterId id) const;
  /// Charges moving all sections written, in the order of the clusters.
  void move_to_common();

  const StoreCount& count() const { return count_; }

 private:
  struct Local {
    bool links = false;
    std::uint64_t patches_bytes = 0, links_bytes = 0;
  };
  Machine& machine_;
  std::map<ClusterId, Local> local_;  ///< what was written in this iteration
  std::vector<char> written_;         ///< by cluster: are its patches in local_?
  StoreCount count_;
};

}  // namespace enfilade
