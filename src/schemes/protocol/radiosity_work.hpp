// The work of a solve: hierarchical radiosity on clusters from the store.
#pragma once

#include <vector>

#include "coarse/coarse_system.hpp"
#include "machine/machine.hpp"
#include "occluders/occluders.hpp"
#include "run/manifest.hpp"
#include "run/prepare.hpp"
#include "schemes/protocol/cluster_work.hpp"
#include "schemes/protocol/gather_cost.hpp"
#include "solver/gather_plan.hpp"
#include "store/cluster_source.hpp"
#include "store/resident_clusters.hpp"

namespace enfilade {

struct RadiosityWorkConfig {
  GatherSettings gather;
  IterationMethod method;
  Hierarchy hierarchy = Hierarchy::building;
  std::uint64_t memory_bytes = 0;  ///< budget for clusters; 0 = no limit
  MemoryManager memory_manager = MemoryManager::own;
  std::uint64_t run = 0;  ///< Manifest::run
  int ranks = 1;          ///< Manifest::ranks
};

class RadiosityWork final : public ClusterWork {
 public:
  /// All but `config` must outlive it.
  RadiosityWork(const Prepared& prepared, const RunLayout& layout,
                ClusterSource<ClusterState>& files, Machine& machine, CostRecorder* recorder,
                const RadiosityWorkConfig& config);

  /// Keeps a cluster of the state before the first iteration in memory; its files must exist.
  void adopt(ClusterState state) { resident_.adopt(std::move(state)); }
  /// Takes the far field's light from the files of the committed iteration: a run that is resumed.
  void restore_far_light(int committed);
  void set_next_use(ResidentClusters::NextUse next_use) {
    resident_.set_next_use(std::move(next_use));
  }

  void begin(const IterationPlan& plan, std::span<const double> changes) override;
  IterationFigures gather(ClusterId receiver) override;
  void hold(std::span<const ClusterId> receivers) override;
  std::vector<ClusterId> resident() const override { return resident_.resident(); }
  void move_to_common() override;
  std::vector<double> far_light() const override { return far_light_; }
  void take_far_light(std::span<const double> lights) override;
  std::vector<double> coarse() const override { return coarse_.to_numbers(); }
  std::vector<double> merge(std::span<const double> a, std::span<const double> b) const override;
  Correction correct(std::span<const double> coarse) const override;
  void commit(const std::vector<IterationSummary>& history, std::span<const double> changes,
              bool finished) override;

  ResidencyCount residency_count() const { return resident_.count(); }
  const Occluders& occluders() const { return occluders_; }
  const CoarseUnknowns& unknowns() const { return unknowns_; }

 private:
  const Prepared& prepared_;
  const RunLayout& layout_;
  ClusterSource<ClusterState>& files_;
  Machine& machine_;
  CostRecorder* recorder_;  ///< null: gathers are not recorded
  RadiosityWorkConfig config_;
  ResidentClusters resident_;
  Occluders occluders_;
  GatherConfig gather_config_;
  std::vector<float> importance_;
  CoarseUnknowns unknowns_;
  BuildingField field_;
  std::vector<double> far_light_;  ///< of this rank: a cluster's number, then its ClusterLight
  std::size_t bands_ = 1;
  double area_m2_ = 0.0;  ///< of all clusters
  CoarseSystem coarse_;
};

}  // namespace enfilade
