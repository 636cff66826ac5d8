#include "schemes/shares/solve_shares.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/checksum.hpp"
#include "base/error.hpp"
#include "base/memory_wanted.hpp"
#include "base/posix_file.hpp"
#include "run/history.hpp"
#include "run/solution.hpp"
#include "schemes/protocol/radiosity_work.hpp"
#include "schemes/shares/relaxation.hpp"
#include "schemes/solve/make_scheme.hpp"
#include "schemes/solve/run_ranks.hpp"
#include "shares/share_scene.hpp"

namespace enfilade {
namespace {

/// Bands that are gathered at once: more shares are found in several turns, in the same memory.
constexpr std::size_t most_bands = 96;
/// The iterations end where the residual, relative to the light of the scene, is below this share
/// of the target error: it is far below what links and points leave. Within limits of use and of
/// rounding.
constexpr double residual_share = 2.5e-3, most_residual = 1e-4, least_residual = 1e-7;
constexpr int most_iterations = 400;

/// The iterations of some of the shares, as rank 0 plans them.
class SharePlanner {
 public:
  /// `last`: of the solve; `repeats`: times that its bands stand in those of the share scene.
  SharePlanner(const IterationSummary& last, std::size_t repeats, double enough)
      : enough_(enough), radius_(reflected_share(last.figures)) {
    plan_.refine = plan_.renew_far = false;
    plan_.close_rows = last.plan.close_rows;
    plan_.openness_rays = last.plan.openness_rays;
    for (std::size_t i = 0; i < repeats; ++i) {
      plan_.flux_correction.insert(plan_.flux_correction.end(), last.plan.flux_correction.begin(),
                                   last.plan.flux_correction.end());
    }
  }

  const IterationPlan& first() const { return plan_; }
  /// The change tells the residual before the iteration. Before and between cycles there is an
  /// iteration of Jacobi's, which tells what the cycle has achieved and what the next one has to.
  IterationPlan next(const IterationSummary& last) {
    const double power = last.figures.received_power;
    residual_ = power > 0.0 ? last.figures.change_power / plan_.relaxation / power : 0.0;
    plan_.converged = residual_ <= enough_;
    plan_.finished = plan_.converged || plan_.iteration >= most_iterations;
    ++plan_.iteration;
    if (plan_.finished) return plan_;
    if (step_ < 0) {
      if (cycle_) radius_ = cycle_->measured(residual_ / (at_cycle_ * radius_));
      at_cycle_ = residual_;
      cycle_.emplace(radius_, enough_ / (residual_ * radius_));
    }
    if (++step_ == cycle_->length()) step_ = -1;
    plan_.relaxation = step_ < 0 ? 1.0 : cycle_->factor(step_);
    return plan_;
  }
  /// Returns how far the iterations have come, 0 .. 1.
  double progress() const {
    return residual_ > 0.0 ? std::clamp(std::log(residual_) / std::log(enough_), 0.0, 1.0) : 0.0;
  }

 private:
  /// A lower bound of the spectral radius, near it where light is even.
  static double reflected_share(const IterationFigures& figures) {
    double share = 0.0;
    for (std::size_t b = 0; b < figures.arriving_power.size(); ++b) {
      if (figures.arriving_power[b] > 0.0)
        share = std::max(share, figures.returning_power[b] / figures.arriving_power[b]);
    }
    return share;
  }

  IterationPlan plan_;
  double enough_, radius_;
  std::optional<ChebyshevCycle> cycle_;
  int step_ = -1;                           ///< of the cycle; -1 = between cycles
  double residual_ = 1.0, at_cycle_ = 0.0;  ///< now, and before the last cycle
};

/// Of this rank's clusters, the light of their leaves that no share has accounted for yet.
class Remainder {
 public:
  explicit Remainder(std::size_t bands) : sums_(2 * bands, 0.0), left_() {}

  void begin(const ClusterState& whole) { left_.push_back(light_of_leaves(whole.patches())); }
  /// Takes off the shares of the i-th of this rank's clusters.
  void take(std::size_t i, const ClusterState& wide) {
    const PatchForest& patches = wide.patches();
    const auto lead = static_cast<std::size_t>(patches.lead_bands() * patches.terms());
    std::size_t at = 0;
    for (std::size_t n = 0; n < patches.size(); ++n) {
      if (!patches.node(n).leaf()) continue;
      const std::span<const double> light = patches.irradiance(n);
      for (std::size_t k = lead; k < light.size(); ++k) left_[i][at + k % lead] -= light[k];
      at += lead;
    }
  }
  /// Sums, per band, area times what is left of the i-th cluster, without sign, and its light.
  void add(std::size_t i, const ClusterState& wide) {
    const PatchForest& patches = wide.patches();
    const auto terms = static_cast<std::size_t>(patches.terms()), bands = sums_.size() / 2;
    std::size_t at = 0;
    for (std::size_t n = 0; n < patches.size(); ++n) {
      if (!patches.node(n).leaf()) continue;
      const double m2 = patches.node(n).shape.area_m2;
      for (std::size_t b = 0; b < bands; ++b) {
        sums_[b] += m2 * std::abs(left_[i][at + b * terms]);
        sums_[bands + b] += m2 * patches.irradiance(n)[b * terms];
      }
      at += bands * terms;
    }
  }
  /// Returns on rank 0 the difference of all ranks' clusters; all ranks call it.
  double difference(Communicator& communicator) const {
    Spectrum all(sums_.size(), 0.0);
    for (const std::vector<double>& part : communicator.gather(sums_)) {
      for (std::size_t i = 0; i < part.size(); ++i) all[i] += part[i];
    }
    double worst = 0.0;
    for (std::size_t b = 0; b < all.size() / 2; ++b) {
      if (all[all.size() / 2 + b] > 0.0) worst = std::max(worst, all[b] / all[all.size() / 2 + b]);
    }
    return worst;
  }

 private:
  static std::vector<double> light_of_leaves(const PatchForest& patches) {
    std::vector<double> light;
    for (std::size_t n = 0; n < patches.size(); ++n) {
      if (!patches.node(n).leaf()) continue;
      light.insert(light.end(), patches.irradiance(n).begin(), patches.irradiance(n).end());
    }
    return light;
  }

  Spectrum sums_;
  std::vector<std::vector<double>> left_;
};

/// The cluster of the whole light with room for shares, which are dark but for their exitance.
ClusterState with_shares(const ClusterState& whole, const Cluster& cluster, const Scene& scene) {
  ClusterState wide = same_patches(whole, cluster, scene);
  wide.set_iteration(gathered_before);
  const PatchForest& from = whole.patches();
  for (std::size_t n = 0; n < from.size(); ++n) {
    std::copy(from.irradiance(n).begin(), from.irradiance(n).end(),
              wide.patches().irradiance(n).begin());
  }
  wide.patches().pull();
  return wide;
}

/// What all turns have in common.
struct ShareRun {
  const SolveConfig& config;
  const RunLayout& layout;
  const Manifest& manifest;
  const SolutionReader& solution;
  const std::vector<ClusterId>& own;
  Communicator& communicator;
  Machine& machine;
  const Progress& progress;

  SolveConfig frozen() const {
    SolveConfig frozen = config;
    frozen.run_directory = layout.run + "/shares/work";
    frozen.scheme = Scheme::spmd;
    frozen.method = {.coarse_correction = false, .jacobi = true};
    frozen.gather.basis = manifest.basis;
    frozen.gather.target_points.clear();
    return frozen;
  }
};

/// One turn: the shares of some groups. Writes their files and takes them off the remainder.
/// `prepared` has their share_scene().
void solve_turn(const ShareRun& run, const Prepared& prepared, std::size_t first,
                Remainder& remainder, ShareIndex& index) {
  const SolveConfig config = run.frozen();
  const RunLayout layout(config.run_directory, config.local_directory);
  const std::uint64_t memory =
      config.memory_bytes > 0 ? config.memory_bytes : run.machine.memory_bytes();
  make_directory(layout.common());  // any rank may be the first
  const VisibilityCost cost = tour_cost(prepared, config.gather.basis, memory);
  ClusterStore store(layout, run.manifest.run, run.communicator.rank(), run.communicator.size(),
                     prepared.clusters.size(), run.machine);
  const SchemeParts parts{config, prepared, run.own, cost, store, run.communicator, run.machine};
  const std::unique_ptr<ParallelScheme> scheme = make_scheme(parts);
  RadiosityWork work(prepared, layout, scheme->files(), run.machine, nullptr,
                     {config.gather, config.method, run.manifest.hierarchy, memory,
                      config.memory_manager, run.manifest.run, run.communicator.size()});
  for (const ClusterId id : run.own) {
    const ClusterState whole = run.solution.read(id, true);
    if (first == 0) remainder.begin(whole);
    ClusterState wide = with_shares(whole, prepared.clusters[id.index()], prepared.scene);
    store.write_initial(wide);
    work.adopt(std::move(wide));
  }
  store.end_initial();
  run.communicator.barrier();
  run.communicator.on_root([&] { work.commit({}, {}, false); });
  work.restore_far_light(0);

  const IterationSummary last = history_of(run.manifest).back();
  const auto bands = static_cast<std::size_t>(prepared.scene.bands);
  const double wanted =
      config.tolerance > 0.0 ? config.tolerance : residual_share * config.target_error;
  SharePlanner planner(last, bands / static_cast<std::size_t>(prepared.scene.lead_bands),
                       std::clamp(wanted, least_residual, most_residual));
  std::vector<IterationSummary> history;
  const IterationPlan end = scheme->run(
      work, planner.first(), {}, history,
      [&](std::vector<IterationSummary>& done) { return planner.next(done.back()); },
      [&](const IterationSummary& summary) {
        report_progress(
            run.progress,
            "solve: shares of the light, iteration " + std::to_string(summary.plan.iteration) + ",",
            planner.progress());
      });
  index.iterations += end.iteration - 1;
  index.converged = index.converged && end.converged;
  scheme->files().set_committed(end.iteration - 1);
  const bool is_last = first + index.per_file >= index.names.size();
  ShareWriter writer(run.layout.run, run.manifest, index, first, run.communicator.rank());
  for (std::size_t i = 0; i < run.own.size(); ++i) {
    const auto wide = scheme->files().read_shooter(run.own[i], Light::committed, nullptr);
    remainder.take(i, *wide);
    if (is_last) remainder.add(i, *wide);
    writer.put(*wide);
  }
  writer.end();
  run.communicator.barrier();
}

}  // namespace

ShareIndex solve_shares(const SolveConfig& config, Prepared& prepared, Communicator& communicator,
                        Machine& machine, const Progress& progress) {
  const MemoryPurpose purpose("the shares of the light");
  const RunLayout layout(config.run_directory, config.local_directory);
  const double start_s = machine.now_s();
  std::vector<ShareGroup> groups;
  communicator.on_root([&] {
    if (committed_manifest(layout).history.empty()) {
      throw InputError(layout.run, "shares", "the solve there has not begun",
                       "solve without --resume");
    }
    groups = share_groups(prepared.scene);
    remove_directory(layout.run + "/shares");
    make_directory(layout.run + "/shares");
  });
  const Manifest manifest = committed_manifest(layout);
  groups = share_groups(prepared.scene);
  const auto bands = static_cast<std::size_t>(prepared.scene.bands);
  ShareIndex index;
  index.ranks = communicator.size();
  index.per_file = std::max<std::size_t>(1, most_bands / bands);
  for (const ShareGroup& group : groups) index.names.push_back(group.name);
  const std::vector<ClusterId> own =
      clusters_of(agree_on_owners(prepared, config, communicator), communicator.rank());
  const SolutionReader solution(layout, manifest);
  const ShareRun run{config, layout, manifest, solution, own, communicator, machine, progress};
  Remainder remainder(bands);
  const Scene scene = std::move(prepared.scene);
  for (std::size_t first = 0; first < groups.size(); first += index.per_file) {
    const std::size_t count = std::min(index.per_file, groups.size() - first);
    prepared.scene = share_scene(scene, std::span(groups).subspan(first, count));
    solve_turn(run, prepared, first, remainder, index);
    communicator.barrier();  // each rank has removed its local directory
    communicator.on_root([&] { remove_directory(layout.run + "/shares/work"); });
  }
  prepared.scene = scene;
  index.difference = remainder.difference(communicator);
  communicator.on_root([&] {
    index.solve_s = machine.now_s() - start_s;
    write_share_index(layout.run, manifest, index);
  });
  return index;
}

}  // namespace enfilade
