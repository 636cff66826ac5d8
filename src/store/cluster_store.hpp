// One rank's way to the cluster files: reads from the common directory, writes to its local one,
// moves the files over at the end of an iteration (§3.2, figure 2).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "machine/machine.hpp"
#include "run/run_layout.hpp"
#include "run/section_shelf.hpp"
#include "store/cluster_files.hpp"

namespace enfilade {

/// Bytes and files that this rank moved, at the size that the machine counts them for.
struct StoreCount {
  std::uint64_t bytes_read = 0, bytes_written = 0;
  std::uint64_t files_read = 0, files_written = 0;
};

/// While iteration k is under way, others' clusters are read as iteration k-1 committed them, and
/// those that this rank has gathered already, from its local directory. Iteration k moves into the
/// slot that k-1 does not use; only the manifest makes it the committed one. So a crash at any
/// moment leaves k-1 whole.
class ClusterStore final : public ClusterFiles {
 public:
  /// Makes the rank's local directory, empty; it goes with the store.
  ClusterStore(const RunLayout& layout, Rank rank, std::size_t clusters, Machine& machine,
               std::unique_ptr<SectionShelf> shelf = std::make_unique<FileShelf>());
  ~ClusterStore() override;
  ClusterStore(const ClusterStore&) = delete;
  ClusterStore& operator=(const ClusterStore&) = delete;

  /// Writes a cluster as the state before the first iteration, straight into the common directory.
  /// That is the end of the preparation, not part of the run: it is neither charged nor counted.
  void write_initial(const ClusterState& state);
  void set_committed(int iteration) override { committed_ = iteration; }
  int committed() const override { return committed_; }

  SectionFile read_geometry(ClusterId id) override;
  SectionFile read_patches(ClusterId id) override;
  SectionFile read_committed_patches(ClusterId id) override;
  SectionFile read_links(ClusterId id) override;
  void write(ClusterId id, std::span<const std::byte> patches, const RecordCount& patches_count,
             std::span<const std::byte> links, const RecordCount& links_count) override;
  /// Has this rank gathered for the cluster in this iteration?
  bool written(ClusterId id) const override { return written_[id.index()] != 0; }
  void move_to_common() override;

  const StoreCount& count() const { return count_; }
  const RunLayout& layout() const { return layout_; }

 private:
  struct Local {
    bool links = false;  ///< its links were written as well
    std::uint64_t patches_bytes = 0, links_bytes = 0;
  };
  SectionFile read(Disk disk, const std::string& path, ClusterId id, Section section,
                   int iteration);
  std::uint64_t put(Disk disk, const std::string& path, const SectionInfo& info,
                    std::span<const std::byte> bytes);
  Slot committed_slot() const { return committed_ % 2 == 0 ? Slot::a : Slot::b; }

  RunLayout layout_;
  std::string local_directory_;
  Machine& machine_;
  std::unique_ptr<SectionShelf> shelf_;
  int committed_ = 0;
  std::vector<Slot> links_slot_;      ///< of the newest links, by cluster
  std::map<ClusterId, Local> local_;  ///< what was written in this iteration
  std::vector<char> written_;         ///< by cluster: is it among them?
  StoreCount count_;
};

}  // namespace enfilade
