// One run of the program in one process.
#pragma once

#include <exception>
#include <string>

#include "app/frame/console.hpp"

namespace enfilade {

/// Exit statuses of the program: a failure while running, and bad input or a bad command line.
inline constexpr int broken_run_status = 1, bad_input_status = 2;

/// Returns an error as a user reads it, in the program's own words whatever library it comes from.
std::string words_of(const std::exception& error);

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
  explicit Session(bool root);

 private:
  Console console_;
};

}  // namespace enfilade
