#include "schemes/replay/replay_work.hpp"

#include <algorithm>

namespace enfilade {

ReplayWork::ReplayWork(std::shared_ptr<const ReplayShared> shared, Machine& machine,
                       std::uint64_t memory_bytes, MemoryManager manager)
    : shared_(std::move(shared)),
      machine_(machine),
      clusters_(shared_->recording, machine),
      resident_(clusters_, machine, memory_bytes, manager),
      coarse_(shared_->unknowns.count, shared_->recording.bands) {}

void ReplayWork::initialise(std::span<const ClusterId> own) {
  for (const ClusterId id : own) {
    resident_.adopt(RecordedCluster(id, shared_->recording.weight(id, 0)));
  }
}

void ReplayWork::begin(const IterationPlan& plan, std::span<const double>) {
  iteration_ = plan.iteration;
  far_light_.clear();
  clusters_.set_committed(plan.iteration - 1);
  if (shared_->recording.method.coarse_correction) coarse_.clear();
  resident_.set_correction({});
  resident_.set_jacobi(shared_->recording.method.uses_jacobi(plan, shared_->unknowns));
}

IterationFigures ReplayWork::gather(ClusterId receiver) {
  const auto iteration = static_cast<std::size_t>(iteration_) - 1;
  const GatherCost& cost = shared_->recording.gathers[iteration][receiver.index()];
  const bool listed = shared_->recording.hierarchy == Hierarchy::clusters;
  const std::vector<ClusterId> visible =
      listed ? shared_->prepared.graph.visible_to(receiver) : cost.read;
  if (shared_->recording.has_far_light())
    far_light_.resize(far_light_.size() + 1 + cluster_light_size(shared_->recording.bands));

  // Through the building's tree, a gather does not know its shooters before.
  const bool known = !shared_->recording.has_far_light();
  RecordedCluster& state =
      resident_.pin_receiver(receiver, known ? std::span(visible) : std::span<const ClusterId>{});
  for (const ClusterId id : visible) {
    if (id != receiver) resident_.pin_shooter(id);
  }
  spend(machine_, cost.figures.work);
  state.set_patches(cost.patches);
  state.set_links(cost.links);
  if (shared_->recording.method.coarse_correction) {
    const CoarseUnknowns& unknowns = shared_->unknowns;
    const auto count = static_cast<std::uint32_t>(unknowns.count);
    cost.coupled.for_each([&](std::uint32_t place) {
      coarse_.couple(unknowns.first[receiver.index()] + place / count, place % count);
    });
  }
  resident_.write_receiver(receiver, cost.links_changed);
  resident_.unpin();
  return cost.figures;
}

std::vector<double> ReplayWork::merge(std::span<const double> a, std::span<const double> b) const {
  CoarseSystem sum = CoarseSystem::from_numbers(a);
  sum.merge(CoarseSystem::from_numbers(b));
  return sum.to_numbers();
}

Correction ReplayWork::correct(std::span<const double>) const {
  const Recording& recording = shared_->recording;
  const auto iteration = static_cast<std::size_t>(iteration_) - 1;
  const IterationSummary& summary = recording.history[iteration];
  // The figures recorded of the iteration include its correction; those of its gathers do not.
  IterationFigures gathered;
  for (const GatherCost& cost : recording.gathers[iteration]) add(gathered, cost.figures);
  const auto brought = [](Spectrum after, const Spectrum& before) {
    for (std::size_t b = 0; b < std::min(after.size(), before.size()); ++b) after[b] -= before[b];
    return after;
  };
  const std::size_t changes =
      summary.correction_failed ? 0 : shared_->unknowns.count * recording.bands;
  return {std::vector<double>(changes, 0.0), summary.correction_failed, summary.missing_power,
          brought(summary.figures.absorbed_power, gathered.absorbed_power),
          brought(summary.figures.escaping_power, gathered.escaping_power)};
}

void ReplayWork::commit(const std::vector<IterationSummary>&, std::span<const double>, bool) {
  const PhaseScope phase(machine_, Phase::commit);
}

}  // namespace enfilade
