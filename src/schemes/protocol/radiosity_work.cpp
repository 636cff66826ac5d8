#include "schemes/protocol/radiosity_work.hpp"

#include <optional>

#include "solver/importance.hpp"

namespace enfilade {
namespace {

CoupledPlaces coupled(ClusterId receiver, const CoarseRow& row, const CoarseUnknowns& unknowns) {
  CoupledPlaces places;
  for_each_coupling(receiver, row, unknowns,
                    [&](std::uint32_t to, std::uint32_t from, std::span<const double>, bool) {
                      const std::uint32_t aggregate = to - unknowns.first[receiver.index()];
                      places.add(from + aggregate * static_cast<std::uint32_t>(unknowns.count));
                    });
  return places;
}

}  // namespace

RadiosityWork::RadiosityWork(const Prepared& prepared, const RunLayout& layout,
                             ClusterSource<ClusterState>& files, Machine& machine,
                             CostRecorder* recorder, const RadiosityWorkConfig& config)
    : prepared_(prepared),
      layout_(layout),
      files_(files),
      machine_(machine),
      recorder_(recorder),
      config_(config),
      resident_(files, machine, config.memory_bytes, config.memory_manager),
      occluders_(prepared.clusters),
      unknowns_(config.method.unknowns(prepared.clusters)),
      field_(prepared, unknowns_, config.hierarchy),
      bands_(static_cast<std::size_t>(prepared.scene.bands)),
      coarse_(unknowns_.count, bands_) {
  for (const Cluster& cluster : prepared.clusters) area_m2_ += cluster.area_m2;
  WorkCount work;
  importance_ = importance_to(config.gather.target_points, prepared.scene, prepared.clusters,
                              occluders_, work);
  machine.compute(work);
}

void RadiosityWork::begin(const IterationPlan& plan, std::span<const double> changes) {
  files_.set_committed(plan.iteration - 1);
  field_.end_iteration(changes);
  far_light_.clear();
  if (config_.method.coarse_correction) coarse_.clear();
  resident_.set_correction(
      [this, own = std::vector<double>(changes.begin(), changes.end())](ClusterState& state) {
        if (own.empty()) return;
        state.correct(unknowns_.of(state.id(), own, bands_));
      });
  resident_.set_jacobi(config_.method.uses_jacobi(plan, unknowns_));
  gather_config_ = gather_config(plan, config_.gather, config_.method, area_m2_, importance_);
}

void RadiosityWork::take_far_light(std::span<const double> lights) {
  if (!field_.has_tree()) return;
  const std::size_t width = cluster_light_size(bands_);
  for (std::size_t i = 0; i + width < lights.size(); i += width + 1) {
    const auto cluster = static_cast<std::size_t>(lights[i]);
    field_.set(ClusterId(cluster), lights.subspan(i + 1, width));
  }
}

void RadiosityWork::restore_far_light(int committed) {
  if (!field_.has_tree()) return;
  files_.set_committed(committed);
  for (const Cluster& cluster : prepared_.clusters) {
    field_.set(cluster.id, light_of(*files_.read_shooter(cluster.id, Light::committed, nullptr)));
  }
}

void RadiosityWork::hold(std::span<const ClusterId> receivers) {
  if (!field_.lists_shooters()) return;  // a gather finds them as it goes
  std::vector<ClusterId> shooters;
  for (const ClusterId receiver : receivers) {
    std::vector<ClusterId> listed;
    field_.shooters(receiver, listed);
    shooters.insert(shooters.end(), listed.begin(), listed.end());
  }
  resident_.hold(std::move(shooters));
}

IterationFigures RadiosityWork::gather(ClusterId receiver) {
  std::vector<ClusterId> listed, read;
  const Shooters shooters = field_.shooters(receiver, listed);
  ClusterState& state = resident_.pin_receiver(receiver, listed);
  const GatherResult result = enfilade::gather(
      state, shooters,
      [&](ClusterId id) -> const ClusterState& {
        if (machine_.time_passes_by_itself()) listen();  // else spend() listens
        if (field_.hierarchy() == Hierarchy::building) read.push_back(id);
        return resident_.pin_shooter(id);
      },
      prepared_.scene.lights, occluders_, gather_config_);
  spend(machine_, result.figures.work);
  if (config_.method.coarse_correction) coarse_.add(receiver, result.coarse, unknowns_);
  const WrittenReceiver written = resident_.write_receiver(receiver, result.links_changed);
  resident_.unpin();
  if (recorder_ != nullptr) {
    recorder_->add({receiver, result.figures, written.patches, written.links, result.links_changed,
                    config_.method.coarse_correction ? coupled(receiver, result.coarse, unknowns_)
                                                     : CoupledPlaces{},
                    std::move(read)});
  }
  if (field_.has_tree()) {
    far_light_.push_back(static_cast<double>(receiver.value));
    far_light_.insert(far_light_.end(), result.light.begin(), result.light.end());
  }
  return result.figures;
}

void RadiosityWork::move_to_common() {
  files_.move_to_common();
  if (recorder_ != nullptr) recorder_->write(files_.committed() + 1);
}

std::vector<double> RadiosityWork::merge(std::span<const double> a,
                                         std::span<const double> b) const {
  CoarseSystem sum = CoarseSystem::from_numbers(a);
  sum.merge(CoarseSystem::from_numbers(b));
  return sum.to_numbers();
}

Correction RadiosityWork::correct(std::span<const double> coarse) const {
  return correction_of(CoarseSystem::from_numbers(coarse), unknowns_);
}

void RadiosityWork::commit(const std::vector<IterationSummary>& history,
                           std::span<const double> changes, bool finished) {
  Manifest manifest;
  manifest.iteration = history.empty() ? 0 : history.back().plan.iteration;
  manifest.clusters = prepared_.clusters.size();
  manifest.ranks = config_.ranks;
  manifest.basis = config_.gather.basis;
  manifest.hierarchy = field_.hierarchy();
  manifest.scene_hash = prepared_.scene.hash;
  manifest.preparation = prepared_.preparation;
  manifest.run = config_.run;
  manifest.finished = finished;
  manifest.correction.assign(changes.begin(), changes.end());
  manifest.unknowns = unknowns_;
  for (const IterationSummary& summary : history) manifest.history.push_back(to_numbers(summary));
  const PhaseScope phase(machine_, Phase::commit);
  commit_manifest(layout_, manifest);
  if (finished) files_.set_committed(manifest.iteration);  // what it replaces can go
}

}  // namespace enfilade
