// Paths in a RUN directory (README.md lists its files). The names of a cluster's files hold its
// number (§3.3).
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>

#include "base/ids.hpp"

namespace enfilade {

/// The three sections of a cluster (hierarchy/cluster_state.hpp) change at three rates, so each has
/// its own file: geometry never, patches with every iteration, links only where they were refined.
/// So an iteration writes little more than the light. Patches and links have two slots, so that the
/// files of one iteration never overwrite those of the one before.
enum class Slot : std::uint8_t { a = 0, b = 1 };
inline Slot other(Slot slot) { return slot == Slot::a ? Slot::b : Slot::a; }

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

  static std::string stem(ClusterId id) { return "cluster-" + std::to_string(id.value); }
  static std::string geometry(const std::string& directory, ClusterId id) {
    return directory + "/" + stem(id) + ".geometry";
  }
  static std::string patches(const std::string& directory, ClusterId id, Slot slot) {
    return directory + "/" + stem(id) + (slot == Slot::a ? ".patches-a" : ".patches-b");
  }
  static std::string links(const std::string& directory, ClusterId id, Slot slot) {
    return directory + "/" + stem(id) + (slot == Slot::a ? ".links-a" : ".links-b");
  }
};

}  // namespace enfilade
