// A solved RUN, opened to gather from and to draw.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "final_gather/point_gather.hpp"
#include "occluders/occluders.hpp"
#include "report/pictures/solved_scene.hpp"
#include "run/prepare.hpp"

namespace enfilade {

/// The preparation, the solution and the gatherer over both. Neither copied nor moved: its parts
/// refer to each other.
class SolvedRun {
 public:
  /// Throws InputError where RUN holds no solution.
  explicit SolvedRun(const std::string& run_directory, const PointGatherConfig& config = {})
      : SolvedRun(load_prepared(run_directory), run_directory, config) {}
  SolvedRun(Prepared prepared, const std::string& run_directory,
            const PointGatherConfig& config = {});
  SolvedRun(const SolvedRun&) = delete;
  SolvedRun& operator=(const SolvedRun&) = delete;

  const Prepared& prepared() const { return prepared_; }
  const PointGather& gather() const { return gather_; }
  /// For pictures, tables and models; refers to this object.
  SolvedScene solved_scene() const {
    return {prepared_.scene, prepared_.cells, prepared_.clusters, solution_, occluders_};
  }

 private:
  Prepared prepared_;
  std::vector<ClusterState> solution_;
  Occluders occluders_;
  PointGather gather_;
};

enum class ProbeMethod { gather, patches };
/// Of "gather" or "patches"; InputError for any other word.
ProbeMethod probe_method(const std::string& name);

/// Returns the irradiance per band at each probe.
std::vector<Spectrum> irradiance_at(const SolvedRun& run, std::span<const Probe> probes,
                                    ProbeMethod method, const Progress& progress = {});

}  // namespace enfilade
