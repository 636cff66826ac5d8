// One run of the program in one process.
#pragma once

#include <exception>

#include "app/frame/console.hpp"

namespace enfilade {

/// Exit statuses of the program: a failure while running, and bad input or a bad command line.
inline constexpr int broken_run_status = 1, bad_input_status = 2;

/// RankSession (app/solve/rank_session.hpp) is the same for the ranks of an MPI program.
class Session {
 public:
  Session() : Session(true) {}
  virtual ~Session() = default;

  /// True on the one process that prints and writes results: rank 0, or a process that runs alone.
  bool root() const { return console_.speaks(); }
  const Console& console() const { return console_; }
  /// Prints the error on one line and returns the exit status, 1 or 2.
  virtual int fail(const std::exception& error);

 protected:
  explicit Session(bool root) : console_(root) {}

 private:
  Console console_;
};

}  // namespace enfilade
