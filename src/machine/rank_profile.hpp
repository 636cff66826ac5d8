// One rank's phases over time, and the host that it ran on.
#pragma once

#include <string>

#include "machine/phase_profile.hpp"

namespace enfilade {

struct RankProfile {
  std::string host;
  PhaseProfile profile;
};

}  // namespace enfilade
