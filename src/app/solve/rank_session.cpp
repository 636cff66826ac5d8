#include "app/solve/rank_session.hpp"

#include "app/frame/launcher.hpp"
#include "base/error.hpp"
#include "machine/cost_model.hpp"

namespace enfilade {

RankSession::RankSession(int& argc, char**& argv, bool on_every_rank)
    : RankSession(on_every_rank || started_as_rank() ? std::make_unique<Communicator>(argc, argv)
                                                     : nullptr) {}

RankSession::RankSession(std::unique_ptr<Communicator> communicator)
    : Session(!communicator || communicator->root()), communicator_(std::move(communicator)) {}

Communicator& RankSession::communicator() {
  ENFILADE_CHECK(communicator_ != nullptr, "a command for one rank asked for all");
  return *communicator_;
}

Machine& RankSession::machine(const std::string& cost_model_file) {
  if (machine_) return *machine_;
  if (cost_model_file.empty()) {
    machine_ = make_machine({});
  } else {
    std::string text;
    communicator().on_root([&] { text = cost_model_text(cost_model_file); });
    machine_ = make_machine(cost_model_from(communicator().broadcast(text), cost_model_file));
  }
  return *machine_;
}

int RankSession::fail(const std::exception& error) {
  const int status = exit_status_of(error);
  // The rank that fails first reports the error; the others learn of it from that rank.
  if (dynamic_cast<const PeerFailure*>(&error) != nullptr) return status;
  Console(true).error(words_of(error));
  if (communicator_ && communicator_->size() > 1 && !communicator_->others_know())
    communicator_->abort(status);
  return status;
}

}  // namespace enfilade
