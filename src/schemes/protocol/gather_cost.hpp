// The cost of each gather of a run: recorded while it runs, so that the run can be replayed on
// other clusters of computers without its kernels (schemes/replay).
#pragma once

#include <bit>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "solver/building_field.hpp"
#include "solver/iteration_method.hpp"
#include "store/resident_clusters.hpp"

namespace enfilade {

/// Entries of one cluster's rows in the coarse system, as bits: in a large building hardly a place
/// is empty.
class CoupledPlaces {
 public:
  static constexpr std::size_t most_words = std::size_t{1} << 25;  ///< places have 32 bits
  /// `place`: column + unknowns * aggregate of the receiver.
  void add(std::uint32_t place) {
    if (words_.size() <= place / 64) words_.resize(place / 64 + 1, 0);
    words_[place / 64] |= std::uint64_t{1} << place % 64;
  }
  /// Calls take(place) in ascending order.
  template <class Take>
  void for_each(Take take) const {
    for (std::uint32_t i = 0; i < words_.size(); ++i) {
      for (std::uint64_t bits = words_[i]; bits != 0; bits &= bits - 1)
        take(64 * i + static_cast<std::uint32_t>(std::countr_zero(bits)));
    }
  }
  const std::vector<std::uint64_t>& words() const { return words_; }
  static CoupledPlaces of(std::vector<std::uint64_t> words) {
    CoupledPlaces places;
    places.words_ = std::move(words);
    return places;
  }

 private:
  std::vector<std::uint64_t> words_;
};

/// One gather of one cluster: GathersParallel(C) and WriteOnLocalDirectory(C) of figure 2.
struct GatherCost {
  ClusterId cluster;
  IterationFigures figures;      ///< of this gather, with its work
  SectionWeight patches, links;  ///< after the gather
  bool links_changed = false;    ///< only then were links written
  CoupledPlaces coupled;         ///< in the coarse system, if any
  /// The clusters that the gather read, where it found them through the building's tree.
  std::vector<ClusterId> read;
  /// In a file: `coupled` and `read` are those of the iteration before, and are not kept again.
  bool as_before = false;
};

/// A run that can be replayed.
struct Recording {
  std::vector<ClusterWeight> start;              ///< by cluster, before the first iteration
  std::vector<std::vector<GatherCost>> gathers;  ///< [iteration - 1][cluster]
  std::vector<IterationSummary> history;         ///< summaries of the iterations
  std::size_t bands = 1;
  IterationMethod method;
  Basis basis = Basis::linear;
  Hierarchy hierarchy = Hierarchy::clusters;

  bool has_far_light() const { return BuildingField::has_tree(hierarchy, start.size()); }
  /// Returns the size of a cluster's sections after iteration `iteration`; 0 = at the start.
  ClusterWeight weight(ClusterId cluster, int iteration) const;
};

/// Records one rank's gathers, in RUN/costs/<iteration>/rank-<n>.
class CostRecorder {
 public:
  /// `run`: Manifest::run.
  CostRecorder(std::string run_directory, std::uint64_t run, Rank rank, IterationMethod method)
      : directory_(run_directory + "/costs/"), run_(run), rank_(rank), method_(method) {}

  /// Records a cluster before the first iteration.
  void add_start(const ClusterState& state);
  void add(GatherCost cost);
  /// Writes the file of an iteration with the gathers added since the last call; 0 = the clusters
  /// at the start.
  void write(int iteration);

 private:
  std::string directory_;
  std::uint64_t run_ = 0;
  Rank rank_;
  IterationMethod method_;
  std::vector<std::pair<ClusterId, ClusterWeight>> start_;
  std::vector<GatherCost> gathers_;
  int iteration_ = 0;  ///< that gathers_ are of; 0 = not known, before the first write()
  /// By cluster that this rank gathered for: the iteration, and a checksum of `coupled` and `read`.
  std::map<ClusterId, std::pair<int, std::uint64_t>> last_;
};

/// On one rank, before a run begins: removes the recordings of iterations after `committed`.
void drop_costs(const std::string& run_directory, int committed);
/// Reads the recording of a run. Throws InputError where RUN holds no finished
/// run with the costs of all its gathers, RunError where a file is damaged or of another run.
Recording read_recording(const std::string& run_directory, std::size_t clusters);

}  // namespace enfilade
