#include "schemes/solve/run_ranks.hpp"

#include <algorithm>
#include <limits>

#include "base/byte_stream.hpp"
#include "gather/emitted_power.hpp"

namespace enfilade {
namespace {

/// Bytes of each cluster as first read from the disk: an estimate, exact enough to order a tour by.
std::vector<std::uint64_t> expected_bytes(const Prepared& prepared, Basis basis) {
  std::vector<std::uint64_t> bytes;
  const auto values =
      static_cast<std::uint64_t>(prepared.scene.bands) * static_cast<std::uint64_t>(basis);
  for (const Cluster& cluster : prepared.clusters) {
    bytes.push_back(256 + cluster.polygons.size() * (320 + 16 * values));
  }
  return bytes;
}

}  // namespace

std::vector<Rank> agree_on_owners(const Prepared& prepared, const SolveConfig& config,
                                  Communicator& communicator) {
  std::string text;
  communicator.on_root([&] {
    ByteWriter writer;
    writer.put_all(assign_clusters(prepared, config, communicator.size()));
    text = writer.text();
  });
  text = communicator.broadcast(text);
  return ByteReader(text, "the assignment").get_all<Rank>();
}

std::vector<ClusterId> clusters_of(std::span<const Rank> owners, Rank rank) {
  std::vector<ClusterId> own;
  for (std::size_t i = 0; i < owners.size(); ++i) {
    if (owners[i] == rank) own.emplace_back(i);
  }
  return own;
}

VisibilityCost tour_cost(const Prepared& prepared, Basis basis, std::uint64_t memory_bytes) {
  return VisibilityCost(
      prepared.graph, expected_bytes(prepared, basis),
      memory_bytes > 0 ? memory_bytes : std::numeric_limits<std::uint64_t>::max());
}

std::vector<double> emitted_powers(const Prepared& prepared) {
  const Spectrum points = emitted_power(prepared.scene, {});
  std::vector<double> powers;
  for (const Cluster& cluster : prepared.clusters) {
    Spectrum power = emitted_power(prepared.scene, {&cluster, 1});
    for (std::size_t b = 0; b < power.size(); ++b) power[b] -= points[b];
    powers.push_back(power.empty() ? 0.0 : *std::max_element(power.begin(), power.end()));
  }
  return powers;
}

RunRecord run_ranks(RankRun run, Communicator& communicator, Machine& machine,
                    const IterationRun& iterate) {
  communicator.barrier();
  const double start_s = machine.now_s();
  const TimeUse before = machine.time_use();
  const MessageCount sent_before = communicator.sent();
  const IterationPlan last = iterate(run.history);
  const TimeUse after = machine.time_use();
  const auto [store, residency] = run.counts();
  const RankStatistics mine{
      {after.compute_s - before.compute_s, after.io_s - before.io_s, after.idle_s - before.idle_s},
      machine.now_s() - start_s,
      store,
      residency,
      {communicator.sent().messages - sent_before.messages,
       communicator.sent().bytes - sent_before.bytes}};
  return gather_statistics(run.prepared, run.basis, run.emitted, run.history, last, mine,
                           communicator, machine);
}

}  // namespace enfilade
