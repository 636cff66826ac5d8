// Compares the assignments on prepared or solved buildings: one line of CSV for each building,
// method, number of parts and seed. What the columns mean stands in bench/README.md.
#include <fmt/format.h>
#include <fmt/os.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>

#include "base/error.hpp"
#include "partition_figures.hpp"

namespace enfilade::bench {
namespace {

struct StudyOptions {
  std::vector<std::string> runs;
  std::vector<int> parts{2, 4, 8, 16, 32, 64};
  int seeds = 5;
  bool no_seconds = false;
  std::string output;
};

struct Row {
  std::string method;
  AssignmentConfig config;
  PartitionFigures figures;
  double seconds = 0.0;
};

constexpr const char* header =
    "scene,clusters,pairs,figures_from,method,parts,seed,cut_share,form_factor_cut_share,"
    "work_balance,clusters_balance,"
    "mean_foreign_bytes,max_foreign_bytes,all_bytes,seconds_over_metis,seconds\n";

/// One line for each seed that the method looks at.
void measure(const std::string& method, const Prepared& prepared, const ClusterFigures& clusters,
             AssignmentConfig config, int seeds, std::vector<Row>& rows) {
  const FormFactorEstimate weights(prepared.clusters);
  for (int seed = 1; seed <= seeds; ++seed) {
    config.seed = static_cast<std::uint64_t>(seed);
    const auto start = std::chrono::steady_clock::now();
    const auto owner = assign(prepared.graph, weights, config);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    rows.push_back({method, config,
                    partition_figures(prepared.graph, weights, clusters, owner, config.parts),
                    took.count()});
  }
}

/// All methods at one number of parts, and figure 1 from a single choice of first centres.
std::vector<Row> measure_all(const Prepared& prepared, const ClusterFigures& clusters, int parts,
                             int seeds) {
  std::vector<Row> rows;
  for (const char* name : assignment_names()) {
    AssignmentConfig config{.method = assignment_method(name), .parts = parts};
    const bool kmeans = config.method == AssignmentMethod::kmeans;
    const bool random = kmeans || config.method == AssignmentMethod::metis;
    measure(name, prepared, clusters, config, random ? seeds : 1, rows);
    if (!kmeans) continue;
    config.starts = 1;
    measure("kmeans-one-start", prepared, clusters, config, seeds, rows);
  }
  return rows;
}

double mean_metis_seconds(const std::vector<Row>& rows) {
  double sum = 0.0;
  int count = 0;
  for (const Row& row : rows) {
    if (row.config.method != AssignmentMethod::metis) continue;
    sum += row.seconds;
    ++count;
  }
  return std::max(sum / count, 1e-9);
}

std::string study_run(const std::string& run, const StudyOptions& options) {
  const Prepared prepared = load_prepared(run);
  const ClusterFigures clusters = cluster_figures(run, prepared);
  std::uint64_t all_bytes = 0;
  for (std::uint64_t bytes : clusters.bytes) all_bytes += bytes;
  const std::string scene = std::filesystem::weakly_canonical(run).filename().string();
  std::string csv;
  for (int parts : options.parts) {
    const std::vector<Row> rows = measure_all(prepared, clusters, parts, options.seeds);
    const double unit_s = mean_metis_seconds(rows);
    for (const auto& [method, config, f, seconds] : rows) {
      csv += fmt::format(
          "{},{},{},{},{},{},{},{:.5f},{:.5f},{:.4f},{:.4f},{:.0f},{:.0f},{},{:.2g},{}\n", scene,
          prepared.graph.size(), prepared.graph.edges(),
          clusters.solved ? "solution" : "preparation", method, parts, config.seed, f.cut_share,
          f.form_factor_cut_share, f.work_balance, f.clusters_balance, f.mean_foreign_bytes,
          f.max_foreign_bytes, all_bytes, seconds / unit_s,
          options.no_seconds ? "" : fmt::format("{:.4f}", seconds));
    }
    fmt::print(stderr, "{}: {} parts done\n", scene, parts);
  }
  return csv;
}

void add_options(CLI::App& cli, StudyOptions& o) {
  cli.footer(
      "Example:\n  enfilade prepare scenes/duplex.json -o out/duplex\n"
      "  partition_study out/duplex --parts 2,4,8 -o partitions.csv");
  cli.add_option("RUN", o.runs, "Directories that 'enfilade prepare' or 'solve' has filled")
      ->required();
  cli.add_option("--parts", o.parts, "Numbers of ranks, as 2,4,8")
      ->delimiter(',')
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  cli.add_option("--seeds", o.seeds, "Seeds 1 to N of the methods that draw at random")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  cli.add_flag("--no-seconds", o.no_seconds,
               "Leave the column of seconds empty: what is left depends on the machine in "
               "seconds_over_metis alone");
  cli.add_option("-o,--output", o.output, "CSV file; default: standard output");
}

}  // namespace
}  // namespace enfilade::bench

int main(int argc, char** argv) {
  using namespace enfilade;
  CLI::App cli("Edge cut, balance and bytes to load of every assignment, as CSV");
  bench::StudyOptions options;
  bench::add_options(cli, options);
  CLI11_PARSE(cli, argc, argv);
  try {
    std::string csv = bench::header;
    for (const std::string& run : options.runs) csv += bench::study_run(run, options);
    if (options.output.empty()) {
      std::cout << csv;
    } else {
      fmt::output_file(options.output).print("{}", csv);
    }
  } catch (const InputError& error) {
    fmt::print(stderr, "partition_study: error: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "partition_study: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
