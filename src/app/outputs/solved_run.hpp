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

/// Which light of a run.
struct RunLight {
  bool shares = false;  ///< all of it, and each luminaire's share of it (run/light_shares.hpp)
  /// "NAME=FACTOR" of luminaires and switches that are dimmed; all others are as in the scene.
  std::vector<std::string> switches;
};

/// The preparation, the solution and the gatherer over both. Neither copied nor moved: its parts
/// refer to each other.
class SolvedRun {
 public:
  /// Throws InputError where RUN holds no solution, or not the shares that `light` needs.
  explicit SolvedRun(const std::string& run_directory, const PointGatherConfig& config = {},
                     const RunLight& light = {})
      : SolvedRun(load_prepared(run_directory), run_directory, config, light) {}
  SolvedRun(Prepared prepared, const std::string& run_directory,
            const PointGatherConfig& config = {}, const RunLight& light = {})
      : SolvedRun(open_light(std::move(prepared), run_directory, light), run_directory, config) {}
  SolvedRun(const SolvedRun&) = delete;
  SolvedRun& operator=(const SolvedRun&) = delete;

  const Prepared& prepared() const { return prepared_; }
  const PointGather& gather() const { return gather_; }
  /// Returns another gatherer, with other rays; refers to this object.
  PointGather gather_with(PointGatherConfig config) const;
  /// Relative error of the light of patches, as estimated.
  double patch_error() const { return gather_config_.patch_error; }
  /// Returns the names of the shares, whose bands follow the scene's own; none unless asked for.
  std::span<const std::string> shares() const { return shares_; }
  /// For pictures, tables and models; refers to this object.
  SolvedScene solved_scene() const {
    return {prepared_.scene, prepared_.cells, prepared_.clusters, solution_, occluders_};
  }

 private:
  /// A run as it is opened.
  struct Opened {
    Prepared prepared;
    std::vector<ClusterState> solution;
    std::vector<std::string> shares;
  };
  static Opened open_light(Prepared prepared, const std::string& run_directory,
                           const RunLight& light);
  SolvedRun(Opened opened, const std::string& run_directory, const PointGatherConfig& config);

  Prepared prepared_;
  std::vector<ClusterState> solution_;
  std::vector<std::string> shares_;
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

/// Returns the irradiance per band of the file at each probe, and that of each of the run's shares,
/// which sum to it. By gathering, the error is that of
/// the point; read off patches, it is the estimated error of all patches.
ProbeAnswers irradiance_at(const SolvedRun& run, std::span<const Probe> probes, ProbeMethod method,
                           const Progress& progress = {});

}  // namespace enfilade
