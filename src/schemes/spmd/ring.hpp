// Termination() of §3.3.4: one tour of a token gathers and synchronises, a second one tells what
// follows.
#pragma once

#include <functional>

#include "schemes/spmd/progress_engine.hpp"

namespace enfilade {

/// Called by every rank once it is idle and has moved its files, with its own numbers. On rank 0
/// `decide` turns everybody's into the decision: when it is called, all ranks are idle and have
/// moved. Returns that decision on every rank.
Decision go_round(Communicator& communicator, Machine& machine, ProgressEngine& engine,
                  const Token& own, const std::function<Decision(const Token&)>& decide,
                  const std::function<void(Token& token, const Token& own)>& add_own = fold);

}  // namespace enfilade
