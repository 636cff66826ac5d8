#include "app/session.hpp"

#include <cstdlib>

#include "base/error.hpp"

namespace enfilade {

namespace {

/// Did mpirun, srun or smpirun start this process, perhaps with others beside it?
bool launched_as_rank() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "SMPI_GLOBAL_SIZE"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

}  // namespace

Session::Session(int& argc, char**& argv, bool on_every_rank)
    : communicator_(on_every_rank || launched_as_rank() ? std::make_unique<Communicator>(argc, argv)
                                                        : nullptr),
      console_(root()) {}

Communicator& Session::communicator() {
  ENFILADE_CHECK(communicator_ != nullptr, "a command for one rank asked for all");
  return *communicator_;
}

Machine& Session::machine(const std::string& cost_model_file) {
  if (!machine_) machine_ = make_machine(cost_model_file);
  return *machine_;
}

int Session::fail(const std::exception& error) {
  const int status = exit_status_of(error);
  if (dynamic_cast<const PeerFailure*>(&error) != nullptr) return status;
  // The rank that fails is the one that knows what to say, whether or not it speaks otherwise.
  Console(true).error(error.what());
  if (communicator_ && communicator_->size() > 1 && !communicator_->others_know())
    communicator_->abort(status);
  return status;
}

}  // namespace enfilade
