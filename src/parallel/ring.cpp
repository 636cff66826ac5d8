#include "parallel/ring.hpp"

#include <algorithm>

namespace enfilade {

void fold(Token& token, const Token& own) {
  token.maxima.resize(std::max(token.maxima.size(), own.maxima.size()), 0.0);
  token.sums.resize(std::max(token.sums.size(), own.sums.size()), 0.0);
  for (std::size_t i = 0; i < own.maxima.size(); ++i) {
    token.maxima[i] = std::max(token.maxima[i], own.maxima[i]);
  }
  for (std::size_t i = 0; i < own.sums.size(); ++i) token.sums[i] += own.sums[i];
}

Verdict go_round(Communicator& communicator, Machine& machine, Dialogue& dialogue, const Token& own,
                 const std::function<Verdict(const Token&)>& decide,
                 const std::function<void(Token& token, const Token& own)>& add_own) {
  const PhaseScope phase(machine, Phase::token);
  if (communicator.size() == 1) return decide(own);
  const bool last = communicator.rank().value + 1 == communicator.size();
  Verdict verdict;
  if (communicator.root()) {
    communicator.send(communicator.successor(), own);
    verdict = decide(dialogue.wait_for<Token>());
  } else {
    Token token = dialogue.wait_for<Token>();
    add_own(token, own);
    communicator.send(communicator.successor(), token);
    verdict = dialogue.wait_for<Verdict>();
  }
  if (!last) communicator.send(communicator.successor(), verdict);
  communicator.finish_sends();
  return verdict;
}

}  // namespace enfilade
