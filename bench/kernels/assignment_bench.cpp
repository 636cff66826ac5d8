// The assignments and what they stand on. Arguments: clusters, parts.
#include <benchmark/benchmark.h>

#include <numeric>

#include "assignment/assignment.hpp"
#include "assignment/hop_distance.hpp"
#include "graphs.hpp"

namespace enfilade::bench {
namespace {

void count_edges(benchmark::State& state, const ClusterGraph& graph) {
  state.counters["clusters"] = static_cast<double>(graph.size());
  state.counters["edges"] = static_cast<double>(graph.edges());
  state.counters["edges_per_second"] = benchmark::Counter(
      static_cast<double>(graph.edges()), benchmark::Counter::kIsIterationInvariantRate);
}

void BM_HopDistance(benchmark::State& state) {
  const ClusterGraph graph = building_of(state.range(0));
  std::size_t source = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(hop_distances(graph, source));
    source = (source + 101) % graph.size();
  }
  count_edges(state, graph);
}
BENCHMARK(BM_HopDistance)->Arg(1280)->Arg(13120)->Unit(benchmark::kMillisecond);

/// 256 pivots of one group, which is one batch of searches.
void BM_Centrality(benchmark::State& state) {
  const ClusterGraph graph = building_of(state.range(0));
  const std::vector<std::uint32_t> group(graph.size(), 0);
  std::vector<std::uint32_t> pivots(256);
  for (std::size_t i = 0; i < pivots.size(); ++i) {
    pivots[i] = static_cast<std::uint32_t>(i * graph.size() / pivots.size());
  }
  for (auto _ : state) benchmark::DoNotOptimize(centrality(graph, group, pivots));
  count_edges(state, graph);
}
BENCHMARK(BM_Centrality)->Arg(1280)->Arg(13120)->Unit(benchmark::kMillisecond);

void assign_with(benchmark::State& state, AssignmentMethod method) {
  const ClusterGraph graph = building_of(state.range(0));
  AssignmentConfig config{.method = method, .parts = static_cast<int>(state.range(1))};
  std::vector<Rank> owner;
  for (auto _ : state) {
    owner = assign(graph, {}, config);
    benchmark::DoNotOptimize(owner.data());
  }
  const PartitionQuality q = quality(graph, owner, config.parts);
  count_edges(state, graph);
  state.counters["cut_share"] =
      static_cast<double>(q.edge_cut) / static_cast<double>(graph.edges());
  state.counters["clusters_balance"] = q.imbalance;
}
void BM_KMeans(benchmark::State& state) { assign_with(state, AssignmentMethod::kmeans); }
void BM_Metis(benchmark::State& state) { assign_with(state, AssignmentMethod::metis); }
void BM_Greedy(benchmark::State& state) { assign_with(state, AssignmentMethod::greedy); }

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Unit(benchmark::kMillisecond)->ArgNames({"clusters", "parts"});
  for (int parts : {4, 64}) benchmark->Args({1280, parts})->Args({13120, parts});
}
BENCHMARK(BM_KMeans)->Apply(sizes);
BENCHMARK(BM_Metis)->Apply(sizes);
BENCHMARK(BM_Greedy)->Apply(sizes);

}  // namespace
}  // namespace enfilade::bench
