// A rank's clusters in segments: reads from the common directory, writes to the rank's local one,
// moves the segments over at the end of an iteration (§3.2, figure 2).
#pragma once

#include <memory>
#include <vector>

#include "run/sections/run_layout.hpp"
#include "run/sections/segment_file.hpp"
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
  /// `run`: Manifest::run; `ranks`: as many as have written into the common directory, or more.
  ClusterStore(const RunLayout& layout, std::uint64_t run, Rank rank, int ranks,
               std::size_t clusters, Machine& machine);
  ~ClusterStore() override;
  ClusterStore(const ClusterStore&) = delete;
  ClusterStore& operator=(const ClusterStore&) = delete;

  /// Writes a cluster as the state before the first iteration, straight into the common directory.
  /// That is the end of the preparation, not part of the run: it is neither charged nor counted.
  /// Others can read it after end_initial().
  void write_initial(const ClusterState& state);
  void end_initial();

  /// Rank 0 removes links that this iteration has replaced.
  void set_committed(int iteration) override;
  int committed() const override { return committed_; }
  /// True where this rank has gathered for the cluster in this iteration.
  bool written(ClusterId id) const override { return charges_.written(id); }
  SectionFile load_section(const SectionName& name) override;
  void store_sections(std::vector<SectionFile> sections) override;
  void move_to_common() override;

  const StoreCount& count() const { return charges_.count(); }
  const RunLayout& layout() const { return layout_; }

 private:
  SegmentKind kind(Section section, std::uint32_t iteration) const;
  const SegmentIndex& index_of(Section section);
  SectionFile load_links(ClusterId id);

  RunLayout layout_;
  std::string local_directory_;
  Rank rank_;
  int ranks_;
  Machine& machine_;
  SectionCharges charges_;
  std::uint64_t run_ = 0;
  int committed_ = 0;
  std::vector<SegmentPlace> own_patches_;  ///< by cluster: those written in this iteration
  std::vector<LinksPlace> links_;          ///< the newest ones, by cluster
  /// Of the iteration under way, in the local directory; at first of the initial state, in common.
  std::unique_ptr<SegmentWriter> geometry_writer_, patches_writer_, links_writer_;
  /// Once they are asked for: what lies in common, the patches of the committed iteration.
  std::unique_ptr<SegmentIndex> geometry_, patches_;
};

}  // namespace enfilade
