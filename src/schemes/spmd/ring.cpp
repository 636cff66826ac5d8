#include "schemes/spmd/ring.hpp"

namespace enfilade {

Verdict go_round(Communicator& communicator, Machine& machine, Dialogue& dialogue, const Token& own,
                 const std::function<Verdict(const Token&)>& decide,
                 const std::function<void(Token& token, const Token& own)>& add_own) {
  const PhaseScope phase(machine, Phase::token);
  if (communicator.size() == 1) return decide(own);
  const bool last = communicator.rank().value + 1 == communicator.size();
  Verdict verdict;
  if (communicator.root()) {
    send(communicator, communicator.successor(), own);
    verdict = decide(dialogue.wait_for<Token>());
  } else {
    Token token = dialogue.wait_for<Token>();
    add_own(token, own);
    send(communicator, communicator.successor(), token);
    verdict = dialogue.wait_for<Verdict>();
  }
  if (!last) send(communicator, communicator.successor(), verdict);
  communicator.finish_sends();
  return verdict;
}

}  // namespace enfilade
