// Termination() of §3.3.4: a first tour of the ring gathers the figures of all ranks in a token and
// synchronises; a second tour carries the decision.
#pragma once

#include <functional>

#include "schemes/spmd/progress_engine.hpp"

namespace enfilade {

/// Called by every rank, with its own numbers, once it is idle and has moved its files. `add_own`
/// folds a rank's numbers into the token. On rank 0 `decide` makes the decision from the numbers of
/// all ranks; when it is called, all of them are idle and have moved their files. Returns the
/// decision on every rank.
Decision go_round(Communicator& communicator, Machine& machine, ProgressEngine& engine,
                  const Token& own, const std::function<Decision(const Token&)>& decide,
                  const std::function<void(Token& token, const Token& own)>& add_own = fold);

}  // namespace enfilade
