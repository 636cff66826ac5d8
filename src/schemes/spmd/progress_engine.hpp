// The progress engine of a rank: answers steal requests whatever the rank is waiting for (figure
// 5), and keeps messages of other kinds until they are waited for.
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

  /// Begins the iteration: answers the requests of ranks that began it earlier.
  void start(int iteration);
  /// Handles the messages that have arrived; called between two receiving clusters.
  void progress();
  /// Calls progress() unless the last poll was a moment ago, since polling costs time; called
  /// between two shooters.
  void progress_if_due();
  /// Returns the ranks known to this one to have no cluster left to give in this iteration; they
  /// get no more work in it.
  const RankSet& idle();
  /// WaitForReply of figure 5, for any kind of message: handles messages until one of kind T has
  /// arrived, and returns it.
  template <class T>
  T wait_for() {
    auto& kept = std::get<std::deque<T>>(kept_);
    while (kept.empty()) take(receive(communicator_, machine_));
    T message = std::move(kept.front());
    kept.pop_front();
    return message;
  }

 private:
  struct Early {
    Rank from;
    StealRequest request;
  };
  /// Answers a steal request; keeps any other message.
  void take(Received received);
  /// ReplyToRequest of §3.3.3.
  void reply(Rank thief, const StealRequest& request);

  Communicator& communicator_;
  Machine& machine_;
  TaskList& tasks_;
  int iteration_ = 0;
  double polled_s_ = 0.0;
  RankSet idle_;
  std::deque<Early> early_;  ///< requests of an iteration that this rank has not begun
  std::tuple<std::deque<StealReply>, std::deque<Token>, std::deque<Decision>> kept_;
};

}  // namespace enfilade
