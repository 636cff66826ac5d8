// Recorded gathers in place of the kernels: the same store, memory, stealing and token ring, priced
// by the machine, in a small part of the real time.
#pragma once

#include <memory>
#include <vector>

#include "coarse/coarse_system.hpp"
#include "machine/machine.hpp"
#include "run/prepare.hpp"
#include "schemes/protocol/cluster_work.hpp"
#include "schemes/protocol/gather_cost.hpp"
#include "schemes/replay/recorded_clusters.hpp"
#include "store/resident_clusters.hpp"

namespace enfilade {

/// Data that all ranks of a replay read and none changes.
struct ReplayShared {
  Prepared prepared;
  Recording recording;
  CoarseUnknowns unknowns;
  Spectrum emitted;                    ///< power, per band
  std::vector<double> emitted_powers;  ///< by cluster
};

class ReplayWork final : public ClusterWork {
 public:
  ReplayWork(std::shared_ptr<const ReplayShared> shared, Machine& machine,
             std::uint64_t memory_bytes, MemoryManager manager);

  /// Keeps the assigned clusters in memory, as they were before the first iteration.
  void initialise(std::span<const ClusterId> own);
  void set_next_use(std::function<std::uint64_t(ClusterId, bool)> next_use) {
    resident_.set_next_use(std::move(next_use));
  }

  void begin(const IterationPlan& plan, std::span<const double> changes) override;
  IterationFigures gather(ClusterId receiver) override;
  std::vector<ClusterId> resident() const override { return resident_.resident(); }
  void move_to_common() override { clusters_.move_to_common(); }
  std::vector<double> far_light() const override { return far_light_; }
  std::vector<double> coarse() const override { return coarse_.to_numbers(); }
  std::vector<double> merge(std::span<const double> a, std::span<const double> b) const override;
  /// Returns a correction of the recorded size and figures, without effect on patches.
  Correction correct(std::span<const double> coarse) const override;
  void commit(const std::vector<IterationSummary>& history, std::span<const double> changes,
              bool finished) override;

  const StoreCount& store_count() const { return clusters_.count(); }
  ResidencyCount residency_count() const { return resident_.count(); }

 private:
  std::shared_ptr<const ReplayShared> shared_;
  Machine& machine_;
  RecordedClusters clusters_;
  BasicResidentClusters<RecordedCluster> resident_;
  CoarseSystem coarse_;
  std::vector<double> far_light_;  ///< zeros, as many as there were
  int iteration_ = 0;
};

}  // namespace enfilade
