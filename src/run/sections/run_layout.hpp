// Paths in a RUN directory (src/run/README.md lists its files).
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>

#include "base/ids.hpp"

namespace enfilade {

/// The three sections of a cluster (hierarchy/cluster_state.hpp) change at three rates, so each
/// lies in files of its own kind: geometry never, patches with every iteration, links only where
/// they were refined. So an iteration writes little more than the light. Patches have two slots,
/// and links a file for each iteration, so that the files of one iteration never overwrite those of
/// the one before.
enum class Slot : std::uint8_t { a = 0, b = 1 };

struct RunLayout {
  std::string run;    ///< RUN
  std::string local;  ///< parent of the ranks' local directories

  /// `local_directory`: where the local directories of runs go, each under its RUN's full name with
  /// % for /; none: into RUN/local.
  explicit RunLayout(std::string run_directory, const std::string& local_directory = {})
      : run(std::move(run_directory)), local(run + "/local") {
    if (local_directory.empty()) return;
    std::string name = std::filesystem::weakly_canonical(run).string();
    std::replace(name.begin(), name.end(), '/', '%');
    local = local_directory + "/" + name;
  }

  std::string common() const { return run + "/common"; }
  std::string local_of(Rank rank) const { return local + "/rank-" + std::to_string(rank.value); }
  std::string manifest() const { return common() + "/manifest.json"; }

  /// The kinds of segments (segment_file.hpp).
  static std::string geometry() { return "geometry"; }
  static std::string patches(Slot slot) { return slot == Slot::a ? "patches-a" : "patches-b"; }
  static std::string links(std::uint32_t iteration) { return "links-" + std::to_string(iteration); }
  /// The slot of the patches of an iteration.
  static Slot slot_of(int iteration) { return iteration % 2 == 0 ? Slot::a : Slot::b; }
};

}  // namespace enfilade
