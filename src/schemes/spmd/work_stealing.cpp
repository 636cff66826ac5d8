#include "schemes/spmd/work_stealing.hpp"

namespace enfilade {

WorkStealingClient::WorkStealingClient(Communicator& communicator, Machine& machine,
                                       ProgressEngine& engine)
    : communicator_(communicator), machine_(machine), engine_(engine) {}

void WorkStealingClient::start(int iteration) {
  iteration_ = iteration;
  steals_ = requests_ = 0;
  victim_ = 1;
}

std::optional<ClusterId> WorkStealingClient::request(std::span<const ClusterId> resident) {
  const PhaseScope phase(machine_, Phase::steal);
  for (; victim_ < communicator_.size(); ++victim_) {
    const Rank victim{(communicator_.rank().value + victim_) % communicator_.size()};
    if (engine_.idle().has(victim)) continue;
    ++requests_;
    send(communicator_, victim,
         StealRequest{iteration_, {resident.begin(), resident.end()}, engine_.idle()});
    const StealReply reply = engine_.wait_for<StealReply>();
    if (!reply.cluster.valid()) continue;
    ++steals_;
    return reply.cluster;
  }
  return std::nullopt;
}

}  // namespace enfilade
