// The checks of the SPMD tests, and what all of them share.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "comm/communicator.hpp"
#include "machine/machine.hpp"

#define SPMD_CHECK(condition, text)                                                            \
  do {                                                                                         \
    if (!(condition))                                                                          \
      throw std::runtime_error(std::string(__FILE__) + ":" + std::to_string(__LINE__) + ": " + \
                               #condition + ": " + (text));                                    \
  } while (false)

namespace enfilade::spmd_tests {

struct Context {
  Communicator& communicator;
  Machine& machine;
  std::string directory;  ///< of this test, the same on all ranks
  bool resume = false;
};

void ring_token(Context& context);
void ring_with_one_late_rank(Context& context);
void group_iteration(Context& context);
void stealing(Context& context);
void linear_system(Context& context);
void failing_rank(Context& context);
void failing_root(Context& context);
void solve_rooms(Context& context);
void solve_rooms_as_in_the_paper(Context& context);
void solve_rooms_master_slave(Context& context);
void solve_rooms_replicated(Context& context);
void solve_to_the_end_spmd(Context& context);
void solve_to_the_end_master_slave(Context& context);
void solve_to_the_end_replicated(Context& context);
void solve_rooms_by_jacobi(Context& context);
void solve_in_little_memory(Context& context);
void replay_rooms(Context& context);
void schemes_give_the_sequential_light(Context& context);
void far_light_is_the_sequential_one(Context& context);
void shares_sum_to_the_light(Context& context);
void shares_of_a_tree_sum_to_the_light(Context& context);
void relit_rooms_are_the_solved_ones(Context& context);
void queue_of_clients(Context& context);
void long_message(Context& context);

}  // namespace enfilade::spmd_tests
