#include "schemes/protocol/run_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "scene/equal_bands.hpp"
#include "solver/energy_conservation.hpp"
#include "solver/error_estimate.hpp"

namespace enfilade {
namespace {

/// One column of the ranks' numbers.
std::vector<double> column(const std::vector<std::vector<double>>& ranks, std::size_t which) {
  std::vector<double> values;
  for (const auto& rank : ranks) values.push_back(rank[which]);
  return values;
}

std::int64_t sum(const std::vector<double>& values) {
  double total = 0.0;
  for (const double v : values) total += v;
  return std::llround(total);
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

/// The largest |of - less| / of, over the bands.
double largest_share(const Spectrum& of, const Spectrum& less) {
  double worst = 0.0;
  for (std::size_t b = 0; b < std::min(of.size(), less.size()); ++b) {
    if (of[b] > 0.0) worst = std::max(worst, std::abs(of[b] - less[b]) / of[b]);
  }
  return worst;
}

/// Pairs of clusters that may see each other; where G_cluster was not asked for, those with links.
std::uint64_t cluster_edges(const Prepared& prepared, std::span<const IterationSummary> history) {
  if (prepared.has_visibility) return prepared.graph.edges();
  return history.empty() ? 0 : (history.back().figures.linked_clusters + 1) / 2;
}

void describe_scene(RunRecord& record, const Prepared& prepared, Basis basis,
                    std::span<const IterationSummary> history) {
  record.set("surfaces", prepared.scene.surfaces.size());
  record.set("lights", prepared.scene.lights.size());
  record.set("cells", prepared.cells.open_cells());
  record.set("portals", prepared.cells.portals().size());
  record.set("clusters", prepared.clusters.size());
  record.set("cluster_edges", cluster_edges(prepared, history));
  record.set("bands", bands_of_file(prepared.scene));
  record.set("solved_bands", prepared.scene.bands);
  record.set("basis", basis == Basis::linear ? "linear" : "constant");
}

void set_figures(RunRecord& record, const IterationFigures& figures, InStats when) {
  for_each_figure([&](const FigureName& figure, auto access) {
    if constexpr (!is_list<decltype(access)>) {
      if (figure.in_stats == when) record.set(figure.name, access(figures));
    }
  });
}

/// The sums of rows before their closure, by area, in the last iteration that closed rows; nothing
/// where none did.
void describe_rows(RunRecord& record, const std::vector<IterationSummary>& history) {
  constexpr double low = 0.01, high = 0.99;
  for (std::size_t i = history.size(); i-- > 0;) {
    const RowSums& rows = history[i].figures.rows;
    if (rows.closed_m2 <= 0.0) continue;
    record.set("mean_row_deficit", RunRecord::Value(rows.mean_deficit()));
    record.set("mean_row_ratio", RunRecord::Value(rows.mean_ratio()));
    record.set("row_ratio_1_percent", RunRecord::Value(rows.percentile(low)));
    record.set("row_ratio_99_percent", RunRecord::Value(rows.percentile(high)));
    return;
  }
}

void describe_iterations(RunRecord& record, const Scene& scene, const Spectrum& emitted,
                         const std::vector<IterationSummary>& history, const IterationPlan& last) {
  IterationFigures all;
  for (const IterationSummary& summary : history) add(all, summary.figures);
  const IterationFigures end = history.empty() ? IterationFigures{} : history.back().figures;
  set_figures(record, end, InStats::last);
  record.set("iterations", history.size());
  record.set("converged", RunRecord::Value(last.converged));
  record.set(
      "residual",
      RunRecord::Value(end.received_power > 0.0 ? end.change_power / end.received_power : 0.0));
  const ErrorEstimate error = estimate_error(history, surfaces_power(scene, emitted));
  record.set("estimated_error", RunRecord::Value(error.total()));
  record.set("estimated_discretisation_error", RunRecord::Value(error.discretisation));
  record.set("estimated_visibility_error", RunRecord::Value(error.visibility));
  record.set("estimated_iteration_error", RunRecord::Value(error.iteration));
  record.set("estimated_patch_error", RunRecord::Value(error.patches));
  record.set("iteration_error_bound", RunRecord::Value(error.iteration_bound));
  // flux_balance: emitted less absorbed power, zero in a closed scene. escaping_share: power that
  // the openness rays see escape. Both relative to the emitted power.
  // Of the sky, the sun and the ground only what arrives is known.
  Spectrum sent = emitted;
  if (scene.sky) {
    sent = surfaces_power(scene, emitted).bands;
    for (std::size_t b = 0; b < std::min(sent.size(), end.direct_power.size()); ++b)
      sent[b] += end.direct_power[b];
  }
  record.set("flux_balance", RunRecord::Value(largest_share(sent, end.absorbed_power)));
  Spectrum stays = sent;
  for (std::size_t b = 0; b < std::min(stays.size(), end.escaping_power.size()); ++b) {
    stays[b] -= end.escaping_power[b];
  }
  record.set("escaping_share", RunRecord::Value(largest_share(sent, stays)));
  describe_rows(record, history);
  set_figures(record, all, InStats::total);
}

}  // namespace

RunRecord gather_statistics(const Prepared& prepared, Basis basis, const Spectrum& emitted,
                            const std::vector<IterationSummary>& history, const IterationPlan& last,
                            const RankStatistics& own, Communicator& communicator,
                            const Machine& machine) {
  const auto n = [](std::uint64_t count) { return static_cast<double>(count); };
  const std::uint64_t peak = machine.peak_memory_bytes(own.residency.peak_bytes);
  const std::vector<double> mine = {own.time.compute_s,
                                    own.time.io_s,
                                    own.time.idle_s,
                                    n(own.store.bytes_read),
                                    n(own.store.bytes_written),
                                    n(own.sent.messages),
                                    n(own.sent.bytes),
                                    n(peak),
                                    n(own.residency.peak_bytes),
                                    n(own.residency.over_budget_bytes),
                                    own.span_s,
                                    n(own.residency.placement.extent_bytes),
                                    n(own.residency.placement.swapped_bytes)};
  const auto ranks = communicator.gather(mine);
  RunRecord record;
  if (!communicator.root()) return record;

  describe_scene(record, prepared, basis, history);
  describe_iterations(record, prepared.scene, emitted, history, last);
  record.set("ranks", communicator.size());
  record.set("messages", sum(column(ranks, 5)));
  record.set("message_bytes", sum(column(ranks, 6)));
  record.set("bytes_read", sum(column(ranks, 3)));
  record.set("bytes_written", sum(column(ranks, 4)));
  record.set("peak_rss_bytes", std::llround(largest(column(ranks, 7))));
  record.set("peak_cluster_bytes", std::llround(largest(column(ranks, 8))));
  record.set("over_budget_bytes", std::llround(largest(column(ranks, 9))));
  record.set("heap_extent_bytes", std::llround(largest(column(ranks, 11))));
  record.set("swapped_bytes", sum(column(ranks, 12)));
  record.set("prepare_s", RunRecord::Value(prepared.prepare_s));
  machine.describe(record, largest(column(ranks, 10)));
  record.set("compute_s", RunRecord::Value(column(ranks, 0)));
  record.set("io_s", RunRecord::Value(column(ranks, 1)));
  record.set("idle_s", RunRecord::Value(column(ranks, 2)));
  return record;
}

}  // namespace enfilade
