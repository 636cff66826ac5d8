// One run of the program: its ranks, its machine, and who of them speaks.
#pragma once

#include <memory>
#include <string>

#include "app/console.hpp"
#include "comm/communicator.hpp"
#include "machine/machine.hpp"

namespace enfilade {

/// Made first thing in main(). MPI is started only where several ranks may be there, since starting
/// it takes a third of a second that `enfilade info` need not pay.
class Session {
 public:
  Session(int& argc, char**& argv, bool on_every_rank);

  bool root() const { return !communicator_ || communicator_->root(); }
  const Console& console() const { return console_; }
  /// Throws std::logic_error for a command that was not announced as one for every rank.
  Communicator& communicator();
  /// The machine that this rank runs on, made at the first call. Throws InputError for a bad cost
  /// model.
  Machine& machine(const std::string& cost_model_file = "");

  /// Writes the line that says what went wrong and gives the exit status. Where only this rank
  /// knows of it, it ends the others as well and does not return.
  int fail(const std::exception& error);

 private:
  std::unique_ptr<Communicator> communicator_;
  std::unique_ptr<Machine> machine_;
  Console console_;
};

}  // namespace enfilade
