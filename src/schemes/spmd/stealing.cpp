#include "schemes/spmd/stealing.hpp"

namespace enfilade {

Thief::Thief(Communicator& communicator, Machine& machine, Dialogue& dialogue)
    : communicator_(communicator), machine_(machine), dialogue_(dialogue) {}

void Thief::start(int iteration) {
  iteration_ = iteration;
  steals_ = requests_ = 0;
  victim_ = 1;
}

std::optional<ClusterId> Thief::request(std::span<const ClusterId> resident) {
  const PhaseScope phase(machine_, Phase::steal);
  for (; victim_ < communicator_.size(); ++victim_) {
    const Rank victim{(communicator_.rank().value + victim_) % communicator_.size()};
    if (dialogue_.idle().has(victim)) continue;
    ++requests_;
    send(communicator_, victim,
         StealRequest{iteration_, {resident.begin(), resident.end()}, dialogue_.idle()});
    const StealReply reply = dialogue_.wait_for<StealReply>();
    if (!reply.cluster.valid()) continue;
    ++steals_;
    return reply.cluster;
  }
  return std::nullopt;
}

}  // namespace enfilade
