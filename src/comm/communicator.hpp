// The ranks of a run and the messages between them: the only room that calls MPI. Compiled once
// against Open MPI and once against SimGrid's SMPI, from the same sources.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/ids.hpp"
#include "machine/machine.hpp"

namespace enfilade {

/// Another rank failed and prints its error; this one ends quietly with the same exit status.
class PeerFailure : public std::runtime_error {
 public:
  explicit PeerFailure(int exit_status)
      : std::runtime_error("another rank failed"), exit_status_(exit_status) {}
  int exit_status() const { return exit_status_; }

 private:
  int exit_status_;
};

/// Returns 2 for bad input, 1 for a run that failed.
int exit_status_of(const std::exception& error);

/// A received message: its sender, its tag, its bytes. schemes/protocol/messages.hpp says what the
/// bytes mean.
struct Envelope {
  Rank from;
  int tag = 0;  ///< 1 or more
  std::vector<std::byte> bytes;
};

/// Point-to-point messages sent by this rank, and their payload.
struct MessageCount {
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;
};

/// One a process, made first thing in main(). An MPI call that fails throws RunError.
class Communicator {
 public:
  Communicator(int& argc, char**& argv);
  ~Communicator();
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  Rank rank() const;
  int size() const;
  bool root() const { return rank().value == 0; }
  /// Returns the next rank in the ring of §3.3.4.
  Rank successor() const { return Rank{(rank().value + 1) % size()}; }

  /// Sends a message. Never blocks: the bytes are kept until MPI has sent them. `tag` is 1 or more.
  void send(Rank to, int tag, std::vector<std::byte> bytes);
  /// Returns the next message from anybody, if there is one now.
  std::optional<Envelope> poll();
  /// Waits for the next message from anybody, by Machine::wait_for_message().
  Envelope receive(Machine& machine);
  /// Waits until every message of this rank has left. Deadlocks unless its receivers receive them.
  void finish_sends();
  const MessageCount& sent() const;

  /// Collective operations, for the start and the end of a run: all ranks call them.
  void barrier();
  /// Returns rank 0's text on every rank.
  std::string broadcast(const std::string& text);
  /// Returns on rank 0 the numbers of all ranks, by rank; elsewhere an empty list.
  std::vector<std::vector<double>> gather(std::span<const double> numbers);
  /// Runs `work` on rank 0 alone while the others wait. Where it throws, rank 0 throws that error
  /// and all others throw PeerFailure, so that one line is printed and all leave in order.
  void on_root(const std::function<void()>& work);
  /// True once work of on_root() has failed: every rank knows of it and leaves, none need be
  /// aborted.
  bool others_know() const { return others_know_; }

  /// Ends all ranks of the run at once with this exit status, from any of them.
  [[noreturn]] void abort(int exit_status);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  bool others_know_ = false;
};

}  // namespace enfilade
