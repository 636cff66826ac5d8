// Holds a run's G_cluster against random segments: is a pair missing, and how many are too many?
#include <fmt/format.h>
#include <fmt/os.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <set>

#include "base/error.hpp"
#include "segment_sampler.hpp"

namespace enfilade::bench {
namespace {

struct CheckOptions {
  std::string run, unseen;
  std::uint64_t segments = 10'000'000, seed = 1;
  std::uint64_t first_a_pair = 256, most_a_pair = 2048;
  double stable_share = 0.005;
  std::size_t print = 5;
};

std::string text(const Vec3& p) { return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", p.x, p.y, p.z); }

std::size_t report_misses(SegmentSampler& sampler, const CheckOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const MissCount count = sampler.find_misses(options.segments);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::set<Pair> pairs;
  for (const Miss& miss : count.misses)
    pairs.insert(std::minmax(miss.clusters.first, miss.clusters.second));
  fmt::print(
      "segments {} ({:.2g} a second), open to the ray tracer without an edge {}, exactly {}, "
      "missed pairs {}\n",
      count.segments, static_cast<double>(count.segments) / took.count(), count.suspects,
      count.misses.size(), pairs.size());
  for (std::size_t i = 0; i < std::min(options.print, count.misses.size()); ++i) {
    const Miss& miss = count.misses[i];
    fmt::print("  missed: {} - {} from {} to {}\n", miss.clusters.first, miss.clusters.second,
               text(miss.from), text(miss.to));
  }
  return count.misses.size();
}

void report_tightness(SegmentSampler& sampler, std::size_t edges, const CheckOptions& options) {
  for (const TightnessRound& round :
       sampler.tightness(options.first_a_pair, options.most_a_pair, options.stable_share)) {
    fmt::print("pairs {}, seen by {} segments each {}, ratio {:.3f}\n", edges,
               round.segments_a_pair, round.pairs_seen,
               static_cast<double>(edges) / static_cast<double>(round.pairs_seen));
  }
  if (options.unseen.empty()) return;
  fmt::ostream file = fmt::output_file(options.unseen);
  for (const auto& [a, b] : sampler.unseen()) file.print("{} {}\n", a, b);
}

int check(const CheckOptions& options) {
  const Prepared prepared = load_prepared(options.run);
  SegmentSampler sampler(prepared, options.seed);
  if (options.first_a_pair > 0) report_tightness(sampler, prepared.graph.edges(), options);
  return report_misses(sampler, options) == 0 ? 0 : 1;
}

void add_options(CLI::App& cli, CheckOptions& o) {
  cli.footer(
      "Exit status 1 where a pair is missing.\n"
      "Example:\n  enfilade prepare scenes/duplex.json -o out/duplex\n"
      "  segment_check out/duplex --segments 100000000");
  cli.add_option("RUN", o.run, "Directory that 'enfilade prepare' or 'solve' has filled")
      ->required();
  cli.add_option("--segments", o.segments, "Segments that look for missing pairs")
      ->capture_default_str();
  cli.add_option("--a-pair", o.first_a_pair,
                 "Segments that look for an open line in each pair, doubled until the count is "
                 "stable; 0: do not look")
      ->capture_default_str();
  cli.add_option("--most-a-pair", o.most_a_pair, "... at most")->capture_default_str();
  cli.add_option("--unseen", o.unseen, "Write the pairs that no segment joins to this file");
  cli.add_option("--seed", o.seed, "Seed of the segments")->capture_default_str();
  cli.add_option("--print", o.print, "Misses to print")->capture_default_str();
}

}  // namespace
}  // namespace enfilade::bench

int main(int argc, char** argv) {
  using namespace enfilade;
  CLI::App cli("Random segments between the surfaces of a run, held against its G_cluster");
  bench::CheckOptions options;
  bench::add_options(cli, options);
  CLI11_PARSE(cli, argc, argv);
  try {
    return bench::check(options);
  } catch (const InputError& error) {
    fmt::print(stderr, "segment_check: error: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "segment_check: error: {}\n", error.what());
    return 1;
  }
}
