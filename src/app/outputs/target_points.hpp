// The points at which a solve is asked to hold its error.
#pragma once

#include <span>
#include <string>

#include "base/warnings.hpp"
#include "run/prepare.hpp"

namespace enfilade {

/// Returns a warning where some of the points of this file see nothing, by whose light nothing can
/// be refined.
Warnings blind_target_points(const std::string& file, std::span<const Probe> points,
                             const Prepared& prepared);

}  // namespace enfilade
