// A rank's clusters as files: reads from the common directory, writes to the rank's local one,
// moves the files over at the end of an iteration (§3.2, figure 2).
#pragma once

#include <vector>

#include "run/run_layout.hpp"
#include "store/cluster_files.hpp"
#include "store/section_charges.hpp"

namespace enfilade {

/// While iteration k is under way, clusters are read as iteration k-1 committed them, and those
/// that this rank has gathered for already, from its local directory. Iteration k moves into the
/// slot that k-1 does not use; only the manifest makes it the committed one. So a crash at any
/// moment leaves k-1 whole.
class ClusterStore final : public ClusterFiles {
 public:
  /// Makes the rank's local directory, empty; the directory is removed with the store.
  /// `run`: Manifest::run.
  ClusterStore(const RunLayout& layout, std::uint64_t run, Rank rank, std::size_t clusters,
               Machine& machine);
  ~ClusterStore() override;
  ClusterStore(const ClusterStore&) = delete;
  ClusterStore& operator=(const ClusterStore&) = delete;

  /// Writes a cluster as the state before the first iteration, straight into the common directory.
  /// That is the end of the preparation, not part of the run: it is neither charged nor counted.
  void write_initial(const ClusterState& state);

  void set_committed(int iteration) override { committed_ = iteration; }
  int committed() const override { return committed_; }
  /// True where this rank has gathered for the cluster in this iteration.
  bool written(ClusterId id) const override { return charges_.written(id); }
  SectionFile load_section(const SectionName& name) override;
  void store_sections(std::vector<SectionFile> sections) override;
  void move_to_common() override;

  const StoreCount& count() const { return charges_.count(); }
  const RunLayout& layout() const { return layout_; }

 private:
  Slot committed_slot() const { return committed_ % 2 == 0 ? Slot::a : Slot::b; }
  /// Returns the file of a cluster's patches or links in this iteration.
  std::string path_of(const std::string& directory, ClusterId id, Section section) const;

  RunLayout layout_;
  std::string local_directory_;
  Machine& machine_;
  SectionCharges charges_;
  std::uint64_t run_ = 0;
  int committed_ = 0;
  std::vector<LinksPlace> links_;  ///< the newest ones, by cluster
};

}  // namespace enfilade
