#include "schemes/spmd/progress_engine.hpp"

#include "base/error.hpp"

namespace enfilade {

void ProgressEngine::start(int iteration) {
  iteration_ = iteration;
  idle_ = {};
  std::deque<Early> early;
  early.swap(early_);
  for (const Early& e : early) reply(e.from, e.request);
}

void ProgressEngine::progress() {
  polled_s_ = machine_.now_s();
  while (auto received = poll(communicator_)) take(std::move(*received));
}

void ProgressEngine::progress_if_due() {
  constexpr double may_wait_s = 0.005;  // small beside a gather, and many polls long
  if (machine_.now_s() - polled_s_ > may_wait_s) progress();
}

void ProgressEngine::take(Received received) {
  if (auto* request = std::get_if<StealRequest>(&received.message)) {
    reply(received.from, *request);
  } else if (auto* answer = std::get_if<StealReply>(&received.message)) {
    idle_.add(answer->idle);
    std::get<std::deque<StealReply>>(kept_).push_back(*answer);
  } else if (auto* token = std::get_if<Token>(&received.message)) {
    std::get<std::deque<Token>>(kept_).push_back(std::move(*token));
  } else if (auto* decision = std::get_if<Decision>(&received.message)) {
    std::get<std::deque<Decision>>(kept_).push_back(std::move(*decision));
  } else {
    throw RunError("a message of a scheme with a master came to a rank that has none");
  }
}

void ProgressEngine::reply(Rank thief, const StealRequest& request) {
  if (request.iteration >
      iteration_) {  // the decision has not come round the ring to this rank yet
    early_.push_back({thief, request});
    return;
  }
  idle_.add(request.idle);
  const ClusterId given = tasks_.give(request.resident).value_or(ClusterId{});
  send(communicator_, thief, StealReply{given, idle()});
}

const RankSet& ProgressEngine::idle() {
  if (tasks_.waiting() == 0) idle_.add(communicator_.rank());
  return idle_;
}

}  // namespace enfilade
