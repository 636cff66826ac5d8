#include "app/outputs/solved_run.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>

#include "base/error.hpp"
#include "base/run_on_threads.hpp"
#include "run/history.hpp"
#include "run/light_shares.hpp"
#include "run/solution.hpp"
#include "scene/equal_bands.hpp"
#include "shares/share_scene.hpp"
#include "solver/error_estimate.hpp"

namespace enfilade {
namespace {

/// A point that sees more backs than this is taken to lie behind surfaces.
constexpr double mostly = 0.5;
constexpr double most_factor = 1000.0;

PointGatherConfig with_errors(PointGatherConfig config, const std::string& run_directory) {
  const std::vector<IterationSummary> history = committed_iterations(run_directory);
  if (history.empty()) return config;
  config.patch_error = history.back().error.patches;
  config.reflected_error = reflected_error(history.back());
  return config;
}

/// Returns a factor for each of `names`, 1 where `switches` do not tell another.
std::vector<double> factors_of(std::span<const std::string> switches,
                               const std::vector<std::string>& names) {
  std::vector<double> factors(names.size(), 1.0);
  for (const std::string& text : switches) {
    const std::size_t equals = text.rfind('=');
    double factor = -1.0;
    if (equals != std::string::npos) {
      const char* const end = text.data() + text.size();
      const auto read = std::from_chars(text.data() + equals + 1, end, factor);
      if (read.ec != std::errc() || read.ptr != end) factor = -1.0;
    }
    if (!(factor >= 0.0 && factor <= most_factor)) {
      throw InputError("command line", "--switch", "'" + text + "' tells no factor from 0 to 1000",
                       "write a name and a factor, as in --switch 'desk lamp=0.3'");
    }
    factors[find_group(names, text.substr(0, equals), "--switch")] = factor;
  }
  return factors;
}

/// Parts the light of a run with shares: the whole in front, the shares behind it, which are made
/// to sum to the whole. What little they lack is rounding, and light below zero that is left out.
void set_answer(const SolvedRun& run, const PointIrradiance& light, ProbeAnswer& answer) {
  const Scene& scene = run.prepared().scene;
  const std::size_t shares = run.shares().size(), bands = light.irradiance.size() / (1 + shares);
  const std::span<const double> all(light.irradiance);
  answer.irradiance = in_bands_of_file(scene, all.first(bands));
  answer.error = in_bands_of_file(scene, std::span(light.error).first(bands));
  Spectrum sums(bands, 0.0);
  for (std::size_t i = bands; i < all.size(); ++i) sums[i % bands] += std::max(0.0, all[i]);
  for (std::size_t i = 0; i < shares; ++i) {
    Spectrum share(bands, 0.0);
    for (std::size_t b = 0; b < bands; ++b) {
      if (sums[b] > 0.0) share[b] = std::max(0.0, all[share_band(bands, i, b)]) * all[b] / sums[b];
    }
    answer.shares.emplace_back(run.shares()[i], in_bands_of_file(scene, share));
  }
}

}  // namespace

SolvedRun::Opened SolvedRun::open_light(Prepared prepared, const std::string& run_directory,
                                        const RunLight& light) {
  Opened opened{std::move(prepared), read_solution(run_directory), {}};
  if (!light.shares && light.switches.empty()) return opened;
  LightShares shares = read_light_shares(run_directory, opened.prepared, opened.solution);
  for (const ShareGroup& group : shares.groups) opened.shares.push_back(group.name);
  if (light.shares) {
    opened.prepared.scene = std::move(shares.scene);
    opened.solution = std::move(shares.clusters);
    return opened;
  }
  DimmedSolution result =
      dimmed(shares, opened.prepared, factors_of(light.switches, opened.shares));
  opened.prepared.scene = std::move(result.scene);
  opened.solution = std::move(result.clusters);
  opened.shares.clear();
  return opened;
}

SolvedRun::SolvedRun(Opened opened, const std::string& run_directory,
                     const PointGatherConfig& config)
    : prepared_(std::move(opened.prepared)),
      solution_(std::move(opened.solution)),
      shares_(std::move(opened.shares)),
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
    set_answer(run, light, found.answers[i]);
  });
  found.in_the_open = in_the_open;
  found.behind = behind;
  return found;
}

}  // namespace enfilade
