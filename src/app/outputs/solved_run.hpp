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
#include "scene_file/scene_io.hpp"

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
  /// Returns another gatherer, with other rays; refers to this object.
  PointGather gather_with(PointGatherConfig config) const;
  /// Relative error of the light of patches, as estimated.
  double patch_error() const { return gather_config_.patch_error; }
  /// For pictures, tables and models; refers to this object.
  SolvedScene solved_scene() const {
    return {prepared_.scene, prepared_.cells, prepared_.clusters, solution_, occluders_};
  }

 private:
  Prepared prepared_;
  std::vector<ClusterState> solution_;
  Occluders occluders_;
  PointGatherConfig gather_config_;
  PointGather gather_;
};

enum class ProbeMethod { gather, patches };
/// Of "gather" or "patches"; InputError for any other word.
ProbeMethod probe_method(const std::string& name);

/// The light at points, and what is odd about the points.
struct ProbeAnswers {
  std::vector<ProbeAnswer> answers;
  std::size_t in_the_open = 0;  ///< points that see no surface's front
  std::size_t behind = 0;       ///< points that mostly see backs: in a wall, under a floor
};

/// Returns the irradiance per band of the file at each probe. By gathering, the error is that of
/// the point; read off patches, it is the estimated error of all patches.
ProbeAnswers irradiance_at(const SolvedRun& run, std::span<const Probe> probes, ProbeMethod method,
                           const Progress& progress = {});

}  // namespace enfilade
