#include "schemes/replay/replay_work.hpp"

#include <algorithm>

namespace enfilade {
namespace {

/// Gives the recorded weights out as if they were the sections' bytes.
class RecordShelf final : public SectionShelf {
 public:
  explicit RecordShelf(const Recording& recording) : recording_(recording) {}
  void open(const std::string&) override {}
  void close(const std::string&, const std::string&) override {}
  void write(const std::string&, const SectionInfo&, std::span<const std::byte>) override {}
  void exchange(const std::string&, const std::string&) override {}

  SectionFile read(const std::string&, ClusterId cluster, Section section, int iteration) override {
    const ClusterWeight weight = recording_.weight(cluster, iteration);
    SectionFile file;
    file.info.cluster = cluster;
    file.info.section = section;
    file.info.iteration = static_cast<std::uint32_t>(iteration);
    RecordCount& count = file.info.count;
    switch (section) {
      case Section::geometry:
        count = {weight.geometry.count, 0, 0, weight.geometry.file_bytes};
        file.bytes = RecordedCluster::section_bytes(cluster, weight.geometry);
        break;
      case Section::patches:
        count = {0, weight.patches.count, 0, weight.patches.file_bytes};
        file.bytes = RecordedCluster::section_bytes(cluster, weight.patches);
        break;
      case Section::links:
        count = {0, 0, weight.links.count, weight.links.file_bytes};
        file.bytes = RecordedCluster::section_bytes(cluster, weight.links);
        break;
    }
    return file;
  }

 private:
  const Recording& recording_;
};

}  // namespace

ReplayWork::ReplayWork(std::shared_ptr<const ReplayShared> shared, const RunLayout& layout,
                       Rank rank, Machine& machine, std::uint64_t memory_bytes,
                       MemoryManager manager)
    : shared_(std::move(shared)),
      machine_(machine),
      store_(layout, rank, shared_->prepared.clusters.size(), machine,
             std::make_unique<RecordShelf>(shared_->recording)),
      resident_(store_, machine, memory_bytes, manager),
      coarse_(shared_->unknowns.count, shared_->recording.bands) {}

void ReplayWork::initialise(std::span<const ClusterId> own) {
  for (const ClusterId id : own) {
    resident_.adopt(RecordedCluster(id, shared_->recording.weight(id, 0)));
  }
}

void ReplayWork::begin(const IterationPlan& plan, std::span<const double>) {
  iteration_ = plan.iteration;
  store_.set_committed(plan.iteration - 1);
  if (shared_->recording.light.coarse_correction)
    coarse_ = CoarseSystem(shared_->unknowns.count, shared_->recording.bands);
  resident_.set_correction({});
  resident_.set_jacobi(shared_->recording.light.uses_jacobi(plan, shared_->unknowns));
}

IterationFigures ReplayWork::gather(ClusterId receiver) {
  const auto neighbours = shared_->prepared.graph.neighbours(receiver.index());
  std::vector<ClusterId> visible(neighbours.begin(), neighbours.end());
  visible.insert(std::lower_bound(visible.begin(), visible.end(), receiver), receiver);
  const auto iteration = static_cast<std::size_t>(iteration_) - 1;
  const GatherCost& cost = shared_->recording.gathers[iteration][receiver.index()];

  RecordedCluster& state = resident_.pin_receiver(receiver, visible);
  for (const ClusterId id : visible) {
    if (id != receiver) resident_.pin_shooter(id);
  }
  spend(machine_, cost.sums.work);
  state.become(cost.patches, cost.links);
  if (shared_->recording.light.coarse_correction) {
    const CoarseUnknowns& unknowns = shared_->unknowns;
    const auto count = static_cast<std::uint32_t>(unknowns.count);
    for (const std::uint32_t place : cost.coupled) {
      coarse_.couple(unknowns.first[receiver.index()] + place / count, place % count);
    }
  }
  resident_.write_receiver(receiver);
  resident_.unpin();
  return cost.sums;
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
  // What was recorded of the iteration is after its correction, what was of its gathers before it.
  IterationFigures gathered;
  for (const GatherCost& cost : recording.gathers[iteration]) add(gathered, cost.sums);
  const auto brought = [](Spectrum after, const Spectrum& before) {
    for (std::size_t b = 0; b < std::min(after.size(), before.size()); ++b) after[b] -= before[b];
    return after;
  };
  const std::size_t changes =
      summary.correction_failed ? 0 : shared_->unknowns.count * recording.bands;
  return {std::vector<double>(changes, 0.0), summary.correction_failed, summary.missing_power,
          brought(summary.sums.absorbed_power, gathered.absorbed_power),
          brought(summary.sums.escaping_power, gathered.escaping_power)};
}

void ReplayWork::commit(const std::vector<IterationSummary>&, std::span<const double>, bool) {
  const PhaseScope phase(machine_, Phase::commit);
}

}  // namespace enfilade
