// run.json, the mark of a RUN directory: that it is one of ours, and what it is prepared for.
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
  std::string options;  ///< of the preparation, as a text to compare
  double covered_area_m2 = 0.0;
  double prepare_s = 0.0;
  std::vector<PrepareStep> steps;
  Warnings warnings;  ///< what the scene gave rise to
};

/// Nothing where the directory is none of ours.
std::optional<RunMark> read_run_mark(const std::string& run_directory);
void write_run_mark(const std::string& run_directory, const RunMark& mark);

/// Throws InputError where a run must not be put into `run_directory`, or cannot be: it is a file,
/// it holds files of somebody else, or it may not be written.
void check_run_directory(const std::string& run_directory);
/// Makes it, where it is not there, and marks it as one that is being prepared. Throws InputError.
void claim_run_directory(const std::string& run_directory);

}  // namespace enfilade
