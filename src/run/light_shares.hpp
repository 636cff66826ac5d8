// RUN/shares: for each luminaire, or each group of them, its share of the light on the patches of
// the solution.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hierarchy/cluster_state.hpp"
#include "preparation/preparation.hpp"
#include "run/manifest.hpp"
#include "run/sections/segment_file.hpp"
#include "shares/share_groups.hpp"

namespace enfilade {

/// RUN/shares/shares.json: whose shares there are, and how they were found.
struct ShareIndex {
  std::vector<std::string> names;  ///< of the groups, as share_groups() has them
  std::size_t per_file = 1;        ///< shares in each file; the last has the rest
  int ranks = 1;                   ///< that wrote the files
  int iterations = 0;
  bool converged = true;
  /// Sum of all shares less the whole light, before the sum is made the whole: area-weighted L1,
  /// relative to the whole, worst band. It is the error by iterations that the solve left out.
  double difference = 0.0;
  double solve_s = 0.0;
};

/// Writes a rank's part of the shares' light into RUN/shares.
class ShareWriter {
 public:
  /// Of the groups from `first` on, as many as one file holds.
  ShareWriter(const std::string& run_directory, const Manifest& manifest, const ShareIndex& index,
              std::size_t first, Rank rank);
  /// `wide` is of a share_scene() of these groups.
  void put(const ClusterState& wide);
  void end() { segment_.end(); }

 private:
  SegmentWriter segment_;
};

/// Written last: makes the files of all clusters valid.
void write_share_index(const std::string& run_directory, const Manifest& manifest,
                       const ShareIndex& index);
/// Returns the index of a run's shares; none where it has none, or those of another solution than
/// the committed one. Throws RunError where it is damaged.
std::optional<ShareIndex> read_share_index(const std::string& run_directory);

/// True where the index and the files of all clusters are there, undamaged and of the committed
/// solution.
bool has_whole_shares(const std::string& run_directory, std::size_t clusters);

/// The solution with the shares of its light. They sum to the solution, on every patch and at every
/// point.
struct LightShares {
  std::vector<ShareGroup> groups;
  std::size_t bands = 1;  ///< of the solution
  /// share_scene() of the run's scene: for a gatherer at points.
  Scene scene;
  /// By cluster: the patches of the solution in the same order, with the bands of `scene`.
  std::vector<ClusterState> clusters;

  std::size_t size() const { return groups.size(); }
  /// Returns the mean radiosity of a patch (index `node`) by a share.
  double radiosity(ClusterId cluster, std::size_t node, std::size_t share, std::size_t band) const;
  /// Returns the mean irradiance of a patch by a share.
  double irradiance(ClusterId cluster, std::size_t node, std::size_t share, std::size_t band) const;
};

/// Reads the shares of a run. `solution`: as read_solution() returned it; `prepared`: as
/// load_prepared(). Throws InputError where the run has no shares of its committed solution,
/// RunError where a file is damaged.
LightShares read_light_shares(const std::string& run_directory, const Prepared& prepared,
                              std::span<const ClusterState> solution);

/// The scene and the solution with the light of group i times factors[i].
struct DimmedSolution {
  Scene scene;
  std::vector<ClusterState> clusters;
};
DimmedSolution dimmed(const LightShares& shares, const Prepared& prepared,
                      std::span<const double> factors);

}  // namespace enfilade
