#include "parallel/stealing.hpp"

namespace enfilade {

Thief::Thief(Communicator& communicator, Machine& machine, Dialogue& dialogue)
    : communicator_(communicator), machine_(machine), dialogue_(dialogue) {}

void Thief::start(int iteration) {
  iteration_ = iteration;
  steals_ = requests_ = 0;
  victims_.clear();
  for (int i = 1; i < communicator_.size(); ++i) {
    victims_.push_back((communicator_.rank().value + i) % communicator_.size());
  }
}

std::optional<ClusterId> Thief::request(std::span<const ClusterId> resident) {
  const PhaseScope phase(machine_, Phase::steal);
  while (!victims_.empty()) {
    ++requests_;
    communicator_.send(Rank{victims_.front()},
                       StealRequest{iteration_, {resident.begin(), resident.end()}});
    const StealReply reply = dialogue_.wait_for<StealReply>();
    if (reply.cluster.valid()) {
      ++steals_;
      return reply.cluster;
    }
    victims_.erase(victims_.begin());
  }
  return std::nullopt;
}

}  // namespace enfilade
