// The load that other programs put on a simulated disk: a share of its time, constant or by a
// profile over the run, and the same in every run.
#pragma once

#include <string>
#include <vector>

namespace enfilade {

class BackgroundLoad {
 public:
  BackgroundLoad() = default;  ///< an idle disk
  /// `text` is a share of the time in [0, 1), as "0.2"; or a profile over the time of the run, in
  /// seconds, as "0 0.1, 28800 0.5, 64800 0.1, repeat 86400": from each time on, the share that
  /// follows it. After `repeat` seconds the profile begins again; without `repeat` the last share
  /// stays.
  /// Throws InputError(file, where, ...).
  BackgroundLoad(const std::string& text, const std::string& file, const std::string& where);

  /// Returns the time at which a request ends that begins at `start_s` and takes an idle disk
  /// `seconds`.
  double end_s(double start_s, double seconds) const;

 private:
  struct Step {
    double from_s = 0.0, share = 0.0;
  };
  double end_of_step_s(std::size_t i) const;  ///< from the start of a round
  double free_of_round_s() const;             ///< what others leave of a whole round

  std::vector<Step> steps_{Step{}};
  double repeat_s_ = 0.0;  ///< 0 = never
};

}  // namespace enfilade
