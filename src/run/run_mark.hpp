// run.json, the mark of a RUN directory: that enfilade made the directory, and for which scene and
// options it is prepared.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/warnings.hpp"
#include "preparation/preparation.hpp"

namespace enfilade {

struct RunMark {
  bool prepared = false;  ///< false: it is being prepared, or was left so, or is damaged
  std::uint64_t scene_hash = 0;
  std::string options;          ///< of the preparation, as a text to compare
  bool has_visibility = false;  ///< Prepared::has_visibility
  double covered_area_m2 = 0.0;
  double prepare_s = 0.0;
  std::vector<PrepareStep> steps;
  Warnings warnings;  ///< what the scene gave rise to
};

/// Reads the mark; none where the directory has no mark of enfilade.
std::optional<RunMark> read_run_mark(const std::string& run_directory);
void write_run_mark(const std::string& run_directory, const RunMark& mark);

/// Throws InputError where a run must not be put into `run_directory`, or cannot be: it is a file,
/// it holds files and has no mark, or it may not be written.
void check_run_directory(const std::string& run_directory);
/// Makes the directory, where there is none, and marks it as being prepared. Throws InputError.
void claim_run_directory(const std::string& run_directory);

}  // namespace enfilade
