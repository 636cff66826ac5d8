#include "app/outputs/solved_run.hpp"

#include <algorithm>
#include <atomic>

#include "base/error.hpp"
#include "base/run_on_threads.hpp"
#include "base/usable_cores.hpp"
#include "run/history.hpp"
#include "run/solution.hpp"
#include "scene/equal_bands.hpp"

namespace enfilade {
namespace {

PointGatherConfig with_patch_error(PointGatherConfig config, const std::string& run_directory) {
  const std::vector<IterationSummary> history = committed_iterations(run_directory);
  if (!history.empty()) config.patch_error = history.back().error.patches;
  return config;
}

}  // namespace

SolvedRun::SolvedRun(Prepared prepared, const std::string& run_directory,
                     const PointGatherConfig& config)
    : prepared_(std::move(prepared)),
      solution_(read_solution(run_directory)),
      occluders_(prepared_.clusters),
      gather_(solution_, prepared_.scene.lights, occluders_,
              with_patch_error(config, run_directory)) {}

ProbeMethod probe_method(const std::string& name) {
  if (name == "gather") return ProbeMethod::gather;
  if (name == "patches") return ProbeMethod::patches;
  throw InputError("command line", "--from", "'" + name + "' is no way to ask",
                   "use gather or patches");
}

std::vector<Spectrum> irradiance_at(const SolvedRun& run, std::span<const Probe> probes,
                                    ProbeMethod method, const Progress& progress) {
  std::vector<Spectrum> answers(probes.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&](bool reports) {
    for (std::size_t i = next++; i < probes.size(); i = next++) {
      const Probe& probe = probes[i];
      answers[i] =
          in_bands_of_file(run.prepared().scene, method == ProbeMethod::gather
                                                     ? run.gather().irradiance(probe.p, probe.n)
                                                     : run.gather().from_patches(probe.p, probe.n));
      if (!reports) continue;
      report_progress(progress, "probe",
                      static_cast<double>(i + 1) / static_cast<double>(probes.size()));
    }
  };
  run_on_threads(static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(usable_cores()),
                                                        probes.size())),
                 work);
  return answers;
}

}  // namespace enfilade
