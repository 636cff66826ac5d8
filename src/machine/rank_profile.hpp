// One rank's phases over time, and where it ran.
#pragma once

#include <string>

#include "machine/phase_profile.hpp"

namespace enfilade {

struct RankProfile {
  std::string host;
  PhaseProfile profile;
};

}  // namespace enfilade
