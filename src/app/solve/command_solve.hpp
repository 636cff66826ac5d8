// The subcommand `solve`, which all ranks carry out.
#pragma once

#include "app/frame/subcommand.hpp"
#include "app/solve/rank_session.hpp"

namespace enfilade {

/// What a command line chose, for all ranks; empty where it did not choose `solve`.
using RankCommand = std::function<void(RankSession&)>;

void add_solve(CLI::App& cli, RankCommand& chosen);

}  // namespace enfilade
