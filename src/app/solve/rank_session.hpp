// One run of the program on all ranks of MPI: their communicator, and the machine of each.
#pragma once

#include <memory>
#include <string>

#include "app/frame/session.hpp"
#include "comm/communicator.hpp"
#include "machine/machine.hpp"

namespace enfilade {

/// Made first in main(). MPI is started for a command of all ranks, and where a launcher started
/// this process; not for a single process's command, as starting MPI takes a third of a second.
class RankSession : public Session {
 public:
  RankSession(int& argc, char**& argv, bool on_every_rank);

  /// Throws std::logic_error where MPI was not started.
  Communicator& communicator();
  /// Returns the machine that this rank runs on, made at the first call, which all ranks
  /// join. The root reads the cost model's file. Throws InputError for a bad one.
  Machine& machine(const std::string& cost_model_file = "");

  /// Prints the error, on whichever rank it arose, and returns the exit status. Where the other
  /// ranks do not know of the error, it ends them as well and does not return.
  int fail(const std::exception& error) override;

 private:
  explicit RankSession(std::unique_ptr<Communicator> communicator);

  std::unique_ptr<Communicator> communicator_;
  std::unique_ptr<Machine> machine_;
};

}  // namespace enfilade
