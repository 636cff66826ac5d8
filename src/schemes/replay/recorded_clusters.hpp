// The clusters of a recorded run, iteration by iteration: only their sizes, charged as files of
// these sizes would be.
#pragma once

#include "schemes/protocol/gather_cost.hpp"
#include "store/cluster_source.hpp"
#include "store/recorded_cluster.hpp"
#include "store/section_charges.hpp"

namespace enfilade {

class RecordedClusters final : public ClusterSource<RecordedCluster> {
 public:
  /// Both must outlive it.
  RecordedClusters(const Recording& recording, Machine& machine)
      : recording_(recording), charges_(machine, recording.start.size()) {}

  void set_committed(int iteration) override { committed_ = iteration; }
  int committed() const override { return committed_; }
  /// True where this rank has gathered for the cluster in this iteration.
  bool written(ClusterId id) const override { return charges_.written(id); }
  std::unique_ptr<RecordedCluster> read_shooter(ClusterId id, Light light,
                                                const RecordedCluster* known) override;
  void read_links(RecordedCluster& cluster) override;
  SectionBytes write(const RecordedCluster& cluster, bool links_changed) override;
  void move_to_common() override { charges_.move_to_common(); }

  const StoreCount& count() const { return charges_.count(); }

 private:
  /// Charges reading a section of this weight; `local`: as this iteration wrote it.
  void read(ClusterId id, Section section, const SectionWeight& weight, bool local);
  ClusterWeight weight(ClusterId id, bool local) const {
    return recording_.weight(id, committed_ + (local ? 1 : 0));
  }

  const Recording& recording_;
  SectionCharges charges_;
  int committed_ = 0;
};

}  // namespace enfilade
