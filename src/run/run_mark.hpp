// run.json, the mark of a RUN directory: that enfilade made the directory, and for which scene and
// options it is prepared.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/warnings.hpp"
#include "preparation/preparation.hpp"
#include "run/run_lock.hpp"

namespace enfilade {

/// 4: checksums of the mark and of all files of the preparation; 5: polygons that walks found dark.
inline constexpr int mark_version = 5;

struct RunMark {
  bool prepared = false;  ///< false: it is being prepared, or was left so, or is damaged
  std::string fault;      ///< why it is not prepared: "damaged (checksum)"; empty: it was left so
  std::uint64_t scene_hash = 0;
  std::string options;          ///< of the preparation, as a text to compare
  bool has_visibility = false;  ///< Prepared::has_visibility
  double covered_area_m2 = 0.0;
  double prepare_s = 0.0;
  std::vector<PrepareStep> steps;
  Warnings warnings;  ///< what the scene gave rise to
  /// checksum() of each file that the preparation made, by name: a file of another run is told.
  std::map<std::string, std::uint64_t> files;

  /// Names what was prepared: the scene, its cells and its clusters.
  std::uint64_t preparation() const;
};

/// Reads the mark; none where the directory has no mark of enfilade.
std::optional<RunMark> read_run_mark(const std::string& run_directory);
void write_run_mark(const std::string& run_directory, const RunMark& mark);

/// Writes a file of the preparation, and enters its checksum in the mark.
void keep_prepared_file(const std::string& run_directory, const std::string& name,
                        std::string_view bytes, RunMark& mark);
/// Returns such a file's bytes. Throws RunError where they are not those that the mark knows.
std::string read_prepared_file(const std::string& run_directory, const std::string& name,
                               const RunMark& mark);

/// Throws InputError where a run must not be put into `run_directory`, or cannot be: it is a file,
/// it holds files and has no mark, or it may not be written.
void check_run_directory(const std::string& run_directory);
/// Makes the directory, where there is none, locks it to write, and marks it as being prepared.
/// Throws InputError.
void claim_run_directory(const std::string& run_directory, RunLock& lock);

}  // namespace enfilade
