// The token ring of §3.3.4: rank 0 gets the numbers of all ranks, all ranks get the decision.
#include "schemes/spmd/ring.hpp"
#include "check.hpp"
#include "visibility/cluster_graph.hpp"

namespace enfilade::spmd_tests {
namespace {

/// No work at all: ranks that are idle from the start.
struct Idle {
  ClusterGraph graph{1, {}};
  VisibilityCost cost{graph, {1}, 1};
  TaskList tasks{{}, cost, make_order(TourOrder::input, 1, graph)};
};

}  // namespace

void ring_token(Context& context) {
  Communicator& c = context.communicator;
  Idle idle;
  ProgressEngine engine(c, context.machine, idle.tasks);
  const double rank = c.rank().value, ranks = c.size();
  for (int round = 1; round <= 50; ++round) {
    engine.start(round);
    const Token own{{rank == 1.0 ? 7.0 * round : -rank}, {rank + 1.0, 1.0}, {}};
    const Decision decision = go_round(c, context.machine, engine, own, [&](const Token& token) {
      SPMD_CHECK(token.maxima.at(0) == (ranks > 1 ? 7.0 * round : 0.0),
                 std::to_string(token.maxima[0]));
      SPMD_CHECK(token.sums.at(0) == ranks * (ranks + 1.0) / 2.0, std::to_string(token.sums[0]));
      SPMD_CHECK(token.sums.at(1) == ranks, std::to_string(token.sums[1]));
      return Decision{token.maxima[0], {static_cast<double>(round), token.sums[0]}, {}};
    });
    SPMD_CHECK(decision.plan.at(0) == round, std::to_string(decision.plan.at(0)));
    SPMD_CHECK(decision.plan.at(1) == ranks * (ranks + 1.0) / 2.0, "plan");
  }
  // Two tours a round: every rank sends the token once, all but the last the decision once.
  const std::uint64_t expected = ranks == 1 ? 0 : (rank + 1 == ranks ? 50u : 100u);
  SPMD_CHECK(c.sent().messages == expected, std::to_string(c.sent().messages));
}

void ring_with_one_late_rank(Context& context) {
  // The token synchronises: no decision before the last rank is idle.
  Communicator& c = context.communicator;
  Idle idle;
  ProgressEngine engine(c, context.machine, idle.tasks);
  engine.start(1);
  c.barrier();
  const double start_s = context.machine.now_s(), late_s = 0.2;
  if (c.rank().value + 1 == c.size()) {
    for (int turn = 0; context.machine.now_s() < start_s + late_s; ++turn)
      context.machine.pause(turn);
  }
  go_round(c, context.machine, engine, Token{}, [](const Token&) { return Decision{}; });
  SPMD_CHECK(context.machine.now_s() >= start_s + 0.95 * late_s,
             std::to_string(context.machine.now_s()));
}

/// Ranks that have gone on to iteration 2 ask rank 0, which is still in iteration 1 and has
/// clusters to give: they get none of that iteration, and one each as soon as rank 0 has gone on as
/// well.
void request_ahead_of_its_iteration(Context& context) {
  Communicator& c = context.communicator;
  constexpr std::uint32_t clusters = 32;
  const ClusterGraph graph(clusters, {});
  const VisibilityCost cost(graph, std::vector<std::uint64_t>(clusters, 100), 1 << 20);
  std::vector<ClusterId> own;
  for (std::uint32_t i = 0; c.root() && i < clusters; ++i) own.emplace_back(i);
  TaskList tasks(own, cost, make_order(TourOrder::input, 1, graph));
  ProgressEngine engine(c, context.machine, tasks);
  tasks.start();
  engine.start(c.root() ? 1 : 2);
  if (!c.root()) send(c, Rank{0}, StealRequest{2, {}, {}});
  c.barrier();
  if (c.root()) {
    const double until_s = context.machine.now_s() + 0.1;  // the requests have come by then
    for (int turn = 0; context.machine.now_s() < until_s; ++turn) {
      engine.progress();
      context.machine.pause(turn);
    }
    SPMD_CHECK(tasks.waiting() == clusters, std::to_string(tasks.waiting()) + " are left");
    engine.start(2);
    while (tasks.waiting() + static_cast<std::size_t>(c.size()) > clusters + 1) {
      engine.progress();
      context.machine.pause(1);
    }
  } else {
    const StealReply reply = engine.wait_for<StealReply>();
    SPMD_CHECK(reply.cluster.valid(), "nothing was given");
  }
  c.finish_sends();
  c.barrier();
}

void long_message(Context& context) {
  // Longer than an inbox, from all to rank 0 at once, between short ones: whole, and in order.
  Communicator& c = context.communicator;
  constexpr std::size_t numbers = 400'000;
  const double rank = c.rank().value;
  send(c, Rank{0}, Token{{rank}, {}, {}});
  send(c, Rank{0}, Token{{rank}, std::vector<double>(numbers, rank + 0.5), {}});
  send(c, Rank{0}, Token{{rank}, {1.0}, {}});
  if (c.root()) {
    std::vector<std::size_t> seen(static_cast<std::size_t>(c.size()), 0);
    for (int i = 0; i < 3 * c.size(); ++i) {
      const Received received = receive(c, context.machine);
      const Token& token = std::get<Token>(received.message);
      std::size_t& turn = seen[static_cast<std::size_t>(received.from.value)];
      const std::size_t expected = turn == 0 ? 0 : turn == 1 ? numbers : 1;
      SPMD_CHECK(token.sums.size() == expected, std::to_string(token.sums.size()));
      SPMD_CHECK(token.maxima.at(0) == received.from.value, "from another rank than it says");
      if (turn == 1) SPMD_CHECK(token.sums.back() == received.from.value + 0.5, "cut or mixed up");
      ++turn;
    }
  }
  c.finish_sends();
  c.barrier();
}

}  // namespace enfilade::spmd_tests
