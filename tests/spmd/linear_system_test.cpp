// The SPMD loop on a linear system with a known answer: §8's iteration to the digit, stealing, and
// going on after a crash.
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include "check.hpp"
#include "linear_system_work.hpp"
#include "schemes/spmd/spmd.hpp"

namespace enfilade::spmd_tests {
namespace {

constexpr std::size_t block_size = 4;

/// Neighbouring blocks to one rank, as the paper's assignment would; none for some where ranks are
/// many.
std::vector<ClusterId> own_blocks(const LinearSystem& system, const Communicator& c) {
  std::vector<ClusterId> own;
  for (std::size_t i = 0; i < system.blocks; ++i) {
    const auto owner = i * static_cast<std::size_t>(c.size()) / system.blocks;
    if (static_cast<int>(owner) == c.rank().value) own.emplace_back(i);
  }
  return own;
}

struct Run {
  LinearSystem system;
  RunLayout layout;
  VisibilityCost cost;
  TaskList tasks;
  LinearSystemWork work;
  std::vector<IterationSummary> history;

  Run(Context& context, std::size_t blocks, LinearSystemWork::Labour labour = {})
      : system(blocks, block_size, 0.8, 42),
        layout(context.directory),
        cost(system.graph, std::vector<std::uint64_t>(blocks, 100), 1 << 30),
        tasks(own_blocks(system, context.communicator), cost,
              make_order(TourOrder::travelling_salesman, 1, system.graph)),
        work(system, layout, context.communicator.rank(), context.machine, std::move(labour)) {
    const std::optional<Manifest> manifest =
        context.resume ? read_manifest(layout) : std::optional<Manifest>{};
    if (manifest) {
      for (const auto& numbers : manifest->history) history.push_back(summary_from(numbers));
    } else {
      context.communicator.on_root([&] { work.initialise(); });
    }
    context.communicator.barrier();
  }

  IterationPlan solve(Context& context, bool steal, int iterations, double tolerance) {
    IterationPlan plan;
    plan.iteration = history.empty() ? 1 : history.back().plan.iteration + 1;
    const auto next = [&](const std::vector<IterationSummary>& so_far) {
      IterationPlan p = so_far.back().plan;
      ++p.iteration;
      p.converged = so_far.back().figures.max_change <= tolerance;
      p.finished = p.converged || so_far.back().plan.iteration >= iterations;
      return p;
    };
    if (!history.empty() && next(history).finished) return next(history);
    return run_spmd(work, tasks, context.communicator, context.machine, {steal, false}, plan, {},
                    history, next);
  }
};

/// Spends `seconds`, as a block's gather. Where time passes only by charges, a thousand times as
/// long, so that there as well gathers take longer than the files.
void labour_for(Machine& machine, double seconds) {
  if (!machine.time_passes_by_itself()) {
    WorkCount work;
    work.rays = static_cast<std::uint64_t>(seconds * 1e12 / 3000.0);
    machine.compute(work);
  } else {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  }
}

/// All ranks' clusters, in the order of their gathers; on rank 0.
std::vector<std::vector<double>> orders(Context& context, const std::vector<ClusterId>& gathered) {
  std::vector<double> numbers;
  for (const ClusterId id : gathered) numbers.push_back(id.value);
  return context.communicator.gather(numbers);
}

void check_solution(Context& context, const LinearSystem& system, const RunLayout& layout) {
  context.communicator.on_root([&] {
    const std::vector<double> x = LinearSystemWork::committed(system, layout);
    const std::vector<double> truth = system.solve_directly();
    for (std::size_t i = 0; i < truth.size(); ++i) {
      SPMD_CHECK(std::abs(x[i] - truth[i]) < 1e-9,
                 std::to_string(x[i]) + " for " + std::to_string(truth[i]));
    }
  });
}

}  // namespace

void group_iteration(Context& context) {
  // Without stealing the loop is exactly §8's: D x(k+1) = b + (L + U) x(k), Gauss-Seidel within a
  // rank.
  Run run(context, 23);
  constexpr int iterations = 6;
  run.solve(context, /*steal=*/false, iterations, 0.0);
  const auto order = orders(context, run.work.gathered());
  context.communicator.on_root([&] {
    const LinearSystem& s = run.system;
    std::vector<double> x = s.b;
    for (int k = 0; k < iterations; ++k) {
      std::vector<double> next = x;
      for (const auto& blocks : order) {
        std::vector<double> mine = x;  // others' values are the last iteration's
        const std::size_t turns = blocks.size() / iterations;
        for (std::size_t t = 0; t < turns; ++t) {
          const auto block =
              static_cast<std::size_t>(blocks[static_cast<std::size_t>(k) * turns + t]);
          for (std::size_t i = block * block_size; i < (block + 1) * block_size; ++i) {
            double value = s.b[i];
            for (std::size_t j = 0; j < s.size(); ++j) value += s.m(i, j) * mine[j];
            mine[i] = next[i] = value;
          }
        }
      }
      x = next;
    }
    const std::vector<double> got = LinearSystemWork::committed(s, run.layout);
    for (std::size_t i = 0; i < x.size(); ++i) {
      SPMD_CHECK(std::abs(got[i] - x[i]) < 1e-14, std::to_string(got[i] - x[i]));
    }
  });
}

void stealing(Context& context) {
  // The first blocks take much longer, and longer than a time slice where ranks share cores: rank 0
  // must give some away, and each block still has its turn exactly once an iteration.
  const std::size_t blocks =
      std::max<std::size_t>(24, 4 * static_cast<std::size_t>(context.communicator.size()));
  const auto labour = [&](ClusterId id) {
    labour_for(context.machine, id.value < 6 ? 2e-2 : 1e-4);
  };
  Run run(context, blocks, labour);
  run.solve(context, /*steal=*/true, 4, 0.0);
  const auto order = orders(context, run.work.gathered());
  context.communicator.on_root([&] {
    std::vector<int> turns(blocks, 0);
    for (const auto& ids : order) {
      for (const double id : ids) ++turns[static_cast<std::size_t>(id)];
    }
    for (const int t : turns) SPMD_CHECK(t == 4, std::to_string(t) + " turns in 4 iterations");
    std::uint64_t steals = 0, requests = 0;
    for (const IterationSummary& summary : run.history) {
      steals += summary.figures.steals;
      requests += summary.figures.steal_requests;
    }
    const bool alone = context.communicator.size() == 1;
    SPMD_CHECK((steals > 0) == !alone, std::to_string(steals) + " steals");
    SPMD_CHECK(requests >= steals, std::to_string(requests) + " requests");
  });
}

void linear_system(Context& context) {
  const auto labour = [&](ClusterId id) {
    labour_for(context.machine, id.value % 5 == 0 ? 2e-3 : 2e-4);
  };
  Run run(context, 24, labour);
  const std::size_t before = run.history.size();
  const IterationPlan last = run.solve(context, /*steal=*/true, 400, 1e-12);
  SPMD_CHECK(last.converged, "not converged");
  check_solution(context, run.system, run.layout);
  context.communicator.on_root([&] {
    const std::size_t now = read_manifest(run.layout).value().history.size();
    std::cout << "went on after iteration " << before << ", ended after iteration " << now
              << std::endl;
    std::uint64_t values = 0;
    for (const IterationSummary& summary : run.history) values += summary.figures.patches;
    SPMD_CHECK(values == now * run.system.size(), "a block missed a turn");
  });
}

}  // namespace enfilade::spmd_tests
