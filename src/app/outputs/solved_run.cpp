#include "app/outputs/solved_run.hpp"

#include "base/error.hpp"
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
  std::vector<Spectrum> answers;
  answers.reserve(probes.size());
  for (const Probe& probe : probes) {
    answers.push_back(
        in_bands_of_file(run.prepared().scene, method == ProbeMethod::gather
                                                   ? run.gather().irradiance(probe.p, probe.n)
                                                   : run.gather().from_patches(probe.p, probe.n)));
    report_progress(progress, "probe",
                    static_cast<double>(answers.size()) / static_cast<double>(probes.size()));
  }
  return answers;
}

}  // namespace enfilade
