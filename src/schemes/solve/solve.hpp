// The solve, from a prepared RUN to its solution: assignment, the state before the first iteration,
// and the iterations of the chosen scheme (figure 2).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "assignment/assignment.hpp"
#include "base/run_record.hpp"
#include "comm/communicator.hpp"
#include "hierarchy/cluster_state.hpp"
#include "links/refinement_oracle.hpp"
#include "machine/machine.hpp"
#include "run/prepare.hpp"
#include "schemes/solve/relight.hpp"
#include "schemes/solve/scheme.hpp"
#include "solver/sequential_solver.hpp"
#include "store/simulated_placement.hpp"
#include "tour/order.hpp"

namespace enfilade {

/// What the solver is asked for, and how the ranks share the work.
struct SolveConfig : SolverConfig {
  std::string run_directory;
  std::string local_directory;  ///< parent of the ranks' local directories; empty = RUN/local
  std::uint64_t memory_bytes =
      0;  ///< budget of a rank for clusters; 0 = the machine's, or no limit
  MemoryManager memory_manager = MemoryManager::own;
  std::uint64_t seed = 1;
  Scheme scheme = Scheme::spmd;
  AssignmentMethod assignment = AssignmentMethod::kmeans;  ///< of Scheme::spmd
  TourOrder order = TourOrder::travelling_salesman;
  bool steal = true;
  bool resume = false;               ///< go on from the last committed iteration
  std::optional<Relight> relight{};  ///< begin with the links of another solution

  /// Returns the hierarchy that is used: the schemes with a master deal out what a cluster sees.
  Hierarchy topmost() const { return scheme == Scheme::spmd ? hierarchy : Hierarchy::clusters; }
};

/// Runs the solve. All ranks call it with the same arguments; rank 0 calls `observer` after every
/// committed iteration. Returns the record of RUN/stats.json on rank 0, elsewhere an empty one. RUN
/// then holds the solution, which read_solution() of run/solution.hpp reads. Throws InputError
/// where config.resume finds the solution of another scene.
RunRecord solve(const SolveConfig& config, const Prepared& prepared, Communicator& communicator,
                Machine& machine, const IterationObserver& observer = {});

/// All ranks call it. True where config.resume finds a solution of this scene that no further
/// iteration would change, however it is asked for. Throws as solve().
bool is_solved(const SolveConfig& config, const Prepared& prepared, Communicator& communicator);

/// Returns owner[i], the rank that cluster i is assigned to before the first iteration.
std::vector<Rank> assign_clusters(const Prepared& prepared, const SolveConfig& config, int ranks);

}  // namespace enfilade
