#include "app/outputs/solved_run.hpp"

#include <atomic>

#include "base/error.hpp"
#include "base/run_on_threads.hpp"
#include "run/history.hpp"
#include "run/solution.hpp"
#include "scene/equal_bands.hpp"
#include "solver/error_estimate.hpp"

namespace enfilade {
namespace {

/// A point that sees more backs than this is taken to lie behind surfaces.
constexpr double mostly = 0.5;

PointGatherConfig with_errors(PointGatherConfig config, const std::string& run_directory) {
  const std::vector<IterationSummary> history = committed_iterations(run_directory);
  if (history.empty()) return config;
  config.patch_error = history.back().error.patches;
  config.reflected_error = reflected_error(history.back());
  return config;
}

}  // namespace

SolvedRun::SolvedRun(Prepared prepared, const std::string& run_directory,
                     const PointGatherConfig& config)
    : prepared_(std::move(prepared)),
      solution_(read_solution(run_directory)),
      occluders_(prepared_.clusters),
      gather_config_(with_errors(config, run_directory)),
      gather_(solution_, prepared_.scene.lights, occluders_, gather_config_) {}

PointGather SolvedRun::gather_with(PointGatherConfig config) const {
  config.patch_error = gather_config_.patch_error;
  config.reflected_error = gather_config_.reflected_error;
  return {solution_, prepared_.scene.lights, occluders_, config};
}

ProbeMethod probe_method(const std::string& name) {
  if (name == "gather") return ProbeMethod::gather;
  if (name == "patches") return ProbeMethod::patches;
  throw InputError("command line", "--from", "'" + name + "' is no way to ask",
                   "use gather or patches");
}

ProbeAnswers irradiance_at(const SolvedRun& run, std::span<const Probe> probes, ProbeMethod method,
                           const Progress& progress) {
  ProbeAnswers found;
  found.answers.resize(probes.size());
  std::atomic<std::size_t> in_the_open{0}, behind{0};
  const auto gather = [&](const Probe& probe) {
    PointIrradiance light = run.gather().at(probe.p, probe.n);
    if (light.back_share > mostly) {
      ++behind;
    } else if (light.front_share == 0.0) {
      ++in_the_open;
    }
    return light;
  };
  const auto read_off = [&](const Probe& probe) {
    PointIrradiance light{run.gather().from_patches(probe.p, probe.n), {}, {}, {}};
    for (const double e : light.irradiance) light.error.push_back(run.patch_error() * e);
    return light;
  };
  for_each_on_threads(probes.size(), "probe", progress, [&](std::size_t i) {
    const PointIrradiance light =
        method == ProbeMethod::gather ? gather(probes[i]) : read_off(probes[i]);
    const Scene& scene = run.prepared().scene;
    found.answers[i] = {in_bands_of_file(scene, light.irradiance),
                        in_bands_of_file(scene, light.error)};
  });
  found.in_the_open = in_the_open;
  found.behind = behind;
  return found;
}

}  // namespace enfilade
