// What others take of a disk while the simulated program runs: a share of its time, the same in
// every run.
#pragma once

#include <string>
#include <vector>

namespace enfilade {

class BackgroundLoad {
 public:
  BackgroundLoad() = default;  ///< nothing
  /// A share of the time in [0, 1), as "0.2"; or a profile over the time of the run, in seconds,
  /// as "0 0.1, 28800 0.5, 64800 0.1, repeat 86400": from each time on, the share that follows it;
  /// after `repeat` seconds it begins again, and without it the last share stays.
  /// Throws InputError(file, where, ...).
  BackgroundLoad(const std::string& text, const std::string& file, const std::string& where);

  /// When work of `seconds` of an idle disk is done that begins at `start_s`.
  double end_s(double start_s, double seconds) const;

 private:
  struct Step {
    double from_s = 0.0, share = 0.0;
  };
  std::vector<Step> steps_{Step{}};
  double repeat_s_ = 0.0;  ///< 0 = never
};

}  // namespace enfilade
