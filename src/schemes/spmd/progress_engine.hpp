// A rank's side of all conversations: requests for work are answered whatever it is waiting for
// (figure 5).
#pragma once

#include <deque>
#include <optional>
#include <tuple>

#include "machine/machine.hpp"
#include "schemes/protocol/messages.hpp"
#include "schemes/spmd/task_list.hpp"

namespace enfilade {

class ProgressEngine {
 public:
  /// All three must outlive it.
  ProgressEngine(Communicator& communicator, Machine& machine, TaskList& tasks)
      : communicator_(communicator), machine_(machine), tasks_(tasks) {}

  /// This rank has begun the iteration: requests that came early are answered now.
  void start(int iteration);
  /// Answers what has arrived; called between two receiving clusters.
  void look();
  /// The same between two shooters, but no sooner than a thief may well wait: looking costs time.
  void look_again();
  /// The ranks that have no cluster left to give in this iteration, as far as this one has heard:
  /// no work comes to them any more.
  const RankSet& idle();
  /// WaitForReply of figure 5, for any kind of message: answers requests until one of kind T is
  /// there.
  template <class T>
  T wait_for() {
    auto& shelf = std::get<std::deque<T>>(shelves_);
    while (shelf.empty()) take(receive(communicator_, machine_));
    T message = std::move(shelf.front());
    shelf.pop_front();
    return message;
  }

 private:
  struct Early {
    Rank from;
    StealRequest request;
  };
  void take(Received received);
  /// ReplyToRequest of §3.3.3.
  void reply(Rank thief, const StealRequest& request);

  Communicator& communicator_;
  Machine& machine_;
  TaskList& tasks_;
  int iteration_ = 0;
  double looked_s_ = 0.0;
  RankSet idle_;
  std::deque<Early> early_;
  std::tuple<std::deque<StealReply>, std::deque<Token>, std::deque<Decision>> shelves_;
};

}  // namespace enfilade
