#include "schemes/master/dealing.hpp"

namespace enfilade {

IterationPlan Master::run(IterationPlan plan, std::vector<double> changes) {
  while (!plan.finished) {
    work_.begin(plan, changes);
    const Token token = deal();
    work_.move_to_common();
    Decision decision = monitor_.decide(plan, token);
    for (int slave = 1; slave < communicator_.size(); ++slave)
      send(communicator_, Rank{slave}, decision);
    communicator_.finish_sends();
    plan = plan_from(decision.plan);
    changes = std::move(decision.correction);
    work_.take_far_light(decision.far_light);
  }
  return plan;
}

Token Master::deal() {
  dealer_.start();
  waiting_.clear();
  tokens_.clear();
  const PhaseScope phase(machine_, Phase::wait);
  while (static_cast<int>(tokens_.size()) + 1 < communicator_.size()) {
    Received received = receive(communicator_, machine_);
    serve(received.from, std::move(received.message));
  }
  IterationFigures own;
  own.steals = dealer_.moved();
  Token all = own_token(work_, own, coarse_correction_);
  for (const auto& [slave, token] :
       tokens_)  // in the order of the ranks: the same sums in each run
    add_token(work_, all, token, coarse_correction_);
  return all;
}

void Master::serve(Rank slave, Message message) {
  if (const auto* request = std::get_if<WorkRequest>(&message)) {
    for (const GatherNote& note : request->done) dealer_.done(slave, note);
    waiting_.push_back(slave);
    answer_waiting();
  } else if (const auto* wanted = std::get_if<SectionRequest>(&message)) {
    SectionReply reply;
    for (const SectionName& name : wanted->sections)
      reply.sections.push_back(store_.load_section(name));
    machine_.settle();
    send(communicator_, slave, reply);
  } else if (auto* result = std::get_if<ClusterResult>(&message)) {
    ENFILADE_CHECK(!result->sections.empty(), "a result without patches");
    store_.store_sections(std::move(result->sections));
  } else if (auto* token = std::get_if<Token>(&message)) {
    tokens_[slave] = std::move(*token);
  } else {
    throw RunError("a slave sent a message that is not for the master");
  }
}

void Master::answer_waiting() {
  std::erase_if(waiting_, [this](Rank slave) {
    const std::optional<WorkOrder> order = dealer_.next(slave);
    if (order) send(communicator_, slave, *order);
    return order.has_value();
  });
}

namespace {

WorkOrder ask_for_work(Communicator& communicator, Machine& machine, WorkRequest request) {
  const PhaseScope phase(machine, Phase::wait);
  send(communicator, Rank{0}, request);
  return receive_from_master<WorkOrder>(communicator, machine);
}

IterationFigures carry_out(ClusterWork& work, RemoteFiles& files, Communicator& communicator,
                           Machine& machine) {
  IterationFigures figures;
  WorkRequest request;
  while (true) {
    const WorkOrder order = ask_for_work(communicator, machine, std::move(request));
    ++figures.steal_requests;
    if (order.gather.empty()) return figures;
    request = {};
    files.know_gathered(order.gathered);
    if (!order.hold.empty()) work.hold(order.hold);
    for (const ClusterId receiver : order.gather) {
      if (order.hold_each) work.hold({&receiver, 1});
      const IterationFigures part = work.gather(receiver);
      request.done.push_back({receiver, part.change_power, part.links});
      add(figures, part);
    }
  }
}

}  // namespace

IterationPlan run_slave(ClusterWork& work, RemoteFiles& files, Communicator& communicator,
                        Machine& machine, bool coarse_correction, IterationPlan plan,
                        std::vector<double> changes) {
  while (!plan.finished) {
    work.begin(plan, changes);
    const IterationFigures figures = carry_out(work, files, communicator, machine);
    work.move_to_common();
    const PhaseScope phase(machine, Phase::token);
    send(communicator, Rank{0}, own_token(work, figures, coarse_correction));
    Decision decision = receive_from_master<Decision>(communicator, machine);
    communicator.finish_sends();
    plan = plan_from(decision.plan);
    changes = std::move(decision.correction);
    work.take_far_light(decision.far_light);
  }
  return plan;
}

}  // namespace enfilade
