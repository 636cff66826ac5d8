#include "schemes/spmd/ring.hpp"

namespace enfilade {

Decision go_round(Communicator& communicator, Machine& machine, ProgressEngine& engine,
                  const Token& own, const std::function<Decision(const Token&)>& decide,
                  const std::function<void(Token& token, const Token& own)>& add_own) {
  const PhaseScope phase(machine, Phase::token);
  if (communicator.size() == 1) return decide(own);
  const bool last = communicator.rank().value + 1 == communicator.size();
  Decision decision;
  if (communicator.root()) {
    send(communicator, communicator.successor(), own);
    decision = decide(engine.wait_for<Token>());
  } else {
    Token token = engine.wait_for<Token>();
    add_own(token, own);
    send(communicator, communicator.successor(), token);
    decision = engine.wait_for<Decision>();
  }
  if (!last) send(communicator, communicator.successor(), decision);
  communicator.finish_sends();
  return decision;
}

}  // namespace enfilade
