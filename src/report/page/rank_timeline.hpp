// What the ranks did over time, as a picture and as a Paje trace.
#pragma once

#include <string>
#include <vector>

#include "machine/rank_profile.hpp"
#include "report/drawing/drawing.hpp"

namespace enfilade {

/// A row a rank (neighbours share a row where there are many), time to the right; in every column
/// the shares of the phases, one above the other. Empty sheet where nothing was done.
Drawing rank_timeline(const std::vector<RankProfile>& ranks);

/// The same for the viewers of Paje traces (ViTE, PajeNG): a container a rank, its state the phase
/// that took most of each bin.
std::string paje_trace(const std::vector<RankProfile>& ranks);

}  // namespace enfilade
