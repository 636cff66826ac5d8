// Reports of progress; `app` decides whether and how to show them.
#pragma once

#include <functional>
#include <string_view>

namespace enfilade {

/// Called with the name of the phase and the fraction done in [0, 1]. May be empty.
using Progress = std::function<void(std::string_view phase, double fraction)>;

inline void report_progress(const Progress& progress, std::string_view phase, double fraction) {
  if (progress) progress(phase, fraction);
}

}  // namespace enfilade
