// OVG's costs and CYCLE. Argument: clusters of the rank whose tour it is.
#include <benchmark/benchmark.h>

#include "graphs.hpp"
#include "tour/order.hpp"
#include "unit/tour/tour_costs.hpp"

namespace enfilade::bench {
namespace {

constexpr std::uint64_t no_limit = std::uint64_t{1} << 60;

void BM_OvgCost(benchmark::State& state) {
  const ClusterGraph graph = building_of(state.range(0));
  const VisibilityCost cost(graph, test::random_bytes(graph.size(), 1), no_limit);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(cost.between(ClusterId(i), ClusterId((i + 37) % graph.size())));
    i = (i + 1) % graph.size();
  }
  state.counters["costs_per_second"] =
      benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_OvgCost)->Arg(1280);

void BM_Cycle(benchmark::State& state) {
  const ClusterGraph graph = building_of(state.range(0));
  const VisibilityCost cost(graph, test::random_bytes(graph.size(), 1), no_limit);
  const std::vector<ClusterId> clusters = test::all_clusters(graph);
  const auto order = make_order(TourOrder::travelling_salesman, 1, graph);
  std::uint64_t bytes = 0;
  for (auto _ : state) {
    bytes = Cycle(order->arrange(clusters, cost), cost).cost_bytes();
  }
  state.counters["clusters_per_second"] = benchmark::Counter(
      static_cast<double>(graph.size()), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["bytes_a_round"] = static_cast<double>(bytes);
}
BENCHMARK(BM_Cycle)->Arg(320)->Arg(1280)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade::bench
