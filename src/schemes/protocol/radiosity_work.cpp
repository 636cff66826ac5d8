#include "schemes/protocol/radiosity_work.hpp"

#include <algorithm>
#include <optional>

namespace enfilade {
namespace {

/// Where a row of the coarse system has entries: column + count * aggregate of the receiver.
std::vector<std::uint32_t> coupled(ClusterId receiver, const CoarseRow& row,
                                   const CoarseUnknowns& unknowns) {
  std::vector<std::uint32_t> places;
  for_each_coupling(
      receiver, row, unknowns,
      [&](std::uint32_t to, std::uint32_t from, std::span<const double>, bool) {
        const std::uint32_t aggregate = to - unknowns.first[receiver.index()];
        places.push_back(from + aggregate * static_cast<std::uint32_t>(unknowns.count));
      });
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

}  // namespace

RadiosityWork::RadiosityWork(const Prepared& prepared, const RunLayout& layout, ClusterFiles& files,
                             Machine& machine, CostRecorder& recorder,
                             const RadiosityWorkConfig& config)
    : prepared_(prepared),
      layout_(layout),
      files_(files),
      machine_(machine),
      recorder_(recorder),
      config_(config),
      resident_(files, machine, config.memory_bytes, config.memory_manager),
      occluders_(prepared.clusters),
      unknowns_(config.light.unknowns(prepared.clusters)),
      bands_(static_cast<std::size_t>(prepared.scene.bands)),
      coarse_(unknowns_.count, bands_) {
  for (const Cluster& cluster : prepared.clusters) area_m2_ += cluster.area_m2;
}

void RadiosityWork::begin(const IterationPlan& plan, std::span<const double> changes) {
  files_.set_committed(plan.iteration - 1);
  if (config_.light.coarse_correction) coarse_ = CoarseSystem(unknowns_.count, bands_);
  resident_.set_correction(
      [this, own = std::vector<double>(changes.begin(), changes.end())](ClusterState& state) {
        if (own.empty()) return;
        state.correct(unknowns_.of(state.id(), own, bands_));
      });
  resident_.set_jacobi(config_.light.uses_jacobi(plan, unknowns_));
  gather_config_.iteration = plan.iteration;
  gather_config_.refinement.link_tolerance = plan.link_tolerance;
  gather_config_.refine = plan.refine;
  gather_config_.coarse_row = config_.light.coarse_correction;
  gather_config_.close_rows = plan.close_rows;
  gather_config_.flux_correction = plan.flux_correction;
  gather_config_.error_samples = {};
  if (plan.sample) gather_config_.error_samples = sampling(plan);
  gather_config_.refinement.max_depth = config_.max_depth;
  gather_config_.refinement.min_area_m2 = config_.min_area_m2;
  gather_config_.refinement.oracle = config_.oracle;
  gather_config_.refinement.visibility = config_.visibility;
}

/// Half of the points go by area, half by the light that arrives.
ErrorSampleConfig RadiosityWork::sampling(const IterationPlan& plan) const {
  constexpr double points = 256.0;
  ErrorSampleConfig config;
  if (plan.received_power <= 0.0 || area_m2_ <= 0.0) return config;
  config.rays = plan.sample_rays;
  config.per_area = 0.5 * points / area_m2_;
  config.per_power = 0.5 * points / plan.received_power;
  config.mean_irradiance = plan.received_power / area_m2_;
  return config;
}

std::vector<ClusterId> RadiosityWork::visible_to(ClusterId receiver) const {
  std::vector<ClusterId> visible;
  for (const std::uint32_t n : prepared_.graph.neighbours(receiver.index()))
    visible.emplace_back(n);
  visible.insert(std::lower_bound(visible.begin(), visible.end(), receiver), receiver);
  return visible;
}

void RadiosityWork::hold(std::span<const ClusterId> receivers) {
  std::vector<ClusterId> shooters;
  for (const ClusterId receiver : receivers) {
    const std::vector<ClusterId> visible = visible_to(receiver);
    shooters.insert(shooters.end(), visible.begin(), visible.end());
  }
  resident_.hold(std::move(shooters));
}

IterationFigures RadiosityWork::gather(ClusterId receiver) {
  const std::vector<ClusterId> visible = visible_to(receiver);
  ClusterState& state = resident_.pin_receiver(receiver, visible);
  const GatherResult result = enfilade::gather(
      state, visible,
      [this](ClusterId id) -> const ClusterState& {
        if (!machine_.simulated()) listen();  // there, time passes only where it is spent
        return resident_.pin_shooter(id);
      },
      prepared_.scene.lights, occluders_, gather_config_);
  spend(machine_, result.figures.work);
  std::vector<std::uint32_t> places;
  if (config_.light.coarse_correction) {
    coarse_.add(receiver, result.coarse, unknowns_);
    places = coupled(receiver, result.coarse, unknowns_);
  }
  const WrittenReceiver written = resident_.write_receiver(receiver);

  resident_.unpin();
  recorder_.add({receiver, result.figures, written.patches, written.links, std::move(places)});
  return result.figures;
}

void RadiosityWork::move_to_common() {
  files_.move_to_common();
  recorder_.write(files_.committed() + 1);
}

std::vector<double> RadiosityWork::merge(std::span<const double> a,
                                         std::span<const double> b) const {
  CoarseSystem sum = CoarseSystem::from_numbers(a);
  sum.merge(CoarseSystem::from_numbers(b));
  return sum.to_numbers();
}

Correction RadiosityWork::correct(std::span<const double> coarse) const {
  const CoarseSystem system = CoarseSystem::from_numbers(coarse);
  Correction correction;
  std::optional<std::vector<double>> changes = system.solve(unknowns_);
  correction.failed = !changes;
  if (!changes) return correction;
  correction.changes = std::move(*changes);
  correction.missing_power = system.power(correction.changes);
  correction.absorbed_power = system.absorbed(correction.changes);
  correction.escaping_power = system.escaping(correction.changes);
  return correction;
}

void RadiosityWork::commit(const std::vector<IterationSummary>& history,
                           std::span<const double> changes, bool finished) {
  Manifest manifest;
  manifest.iteration = history.empty() ? 0 : history.back().plan.iteration;
  manifest.clusters = prepared_.clusters.size();
  manifest.basis = config_.basis;
  manifest.scene_hash = prepared_.scene.hash;
  manifest.finished = finished;
  manifest.correction.assign(changes.begin(), changes.end());
  manifest.unknowns = unknowns_;
  for (const IterationSummary& summary : history) manifest.history.push_back(to_numbers(summary));
  const PhaseScope phase(machine_, Phase::commit);
  commit_manifest(layout_, manifest);
}

}  // namespace enfilade
