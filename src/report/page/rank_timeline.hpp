// The ranks' phases (compute, I/O, idle) over time, as a drawing and as a Paje trace.
#pragma once

#include <string>
#include <vector>

#include "machine/rank_profile.hpp"
#include "report/drawing/drawing.hpp"

namespace enfilade {

/// Returns one row per rank (neighbours share a row where there are many ranks), time to the right;
/// each column stacks the phases' shares of its time. An empty sheet where no rank did anything.
Drawing rank_timeline(const std::vector<RankProfile>& ranks);

/// Returns a Paje trace for ViTE or PajeNG: one container per rank, whose state is the phase that
/// took most of each bin of time.
std::string paje_trace(const std::vector<RankProfile>& ranks);

}  // namespace enfilade
