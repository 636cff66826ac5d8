// Runs one SPMD test by name, on whatever runtime it is linked with: spmd_tests NAME DIRECTORY
// [--resume]
#include <filesystem>
#include <iostream>
#include <map>

#include "check.hpp"
#include "machine/cost_model.hpp"

using namespace enfilade;
using namespace enfilade::spmd_tests;

int main(int argc, char** argv) {
  Communicator communicator(argc, argv);
  const std::unique_ptr<Machine> machine = make_machine({});
  const std::map<std::string, void (*)(Context&)> tests = {
      {"ring_token", ring_token},
      {"request_ahead_of_its_iteration", request_ahead_of_its_iteration},
      {"ring_with_one_late_rank", ring_with_one_late_rank},
      {"group_iteration", group_iteration},
      {"stealing", stealing},
      {"linear_system", linear_system},
      {"failing_rank", failing_rank},
      {"failing_root", failing_root},
      {"solve_rooms", solve_rooms},
      {"solve_rooms_as_in_the_paper", solve_rooms_as_in_the_paper},
      {"solve_rooms_master_slave", solve_rooms_master_slave},
      {"solve_rooms_replicated", solve_rooms_replicated},
      {"solve_to_the_end_spmd", solve_to_the_end_spmd},
      {"solve_to_the_end_master_slave", solve_to_the_end_master_slave},
      {"solve_to_the_end_replicated", solve_to_the_end_replicated},
      {"solve_rooms_by_jacobi", solve_rooms_by_jacobi},
      {"long_message", long_message},
      {"solve_in_little_memory", solve_in_little_memory},
      {"replay_rooms", replay_rooms},
      {"schemes_give_the_sequential_light", schemes_give_the_sequential_light},
      {"far_light_is_the_sequential_one", far_light_is_the_sequential_one},
      {"shares_sum_to_the_light", shares_sum_to_the_light},
      {"shares_of_a_tree_sum_to_the_light", shares_of_a_tree_sum_to_the_light},
      {"relit_rooms_are_the_solved_ones", relit_rooms_are_the_solved_ones},
      {"queue_of_clients", queue_of_clients}};
  try {
    if (argc < 3) throw std::runtime_error("usage: spmd_tests NAME DIRECTORY [--resume]");
    Context context{communicator, *machine, argv[2], argc > 3};
    communicator.on_root([&] { std::filesystem::create_directories(context.directory); });
    tests.at(argv[1])(context);
  } catch (const PeerFailure& failure) {
    return failure.exit_status();
  } catch (const std::exception& error) {
    std::cerr << "rank " << communicator.rank().value << ": " << error.what() << std::endl;
    if (communicator.others_know()) return exit_status_of(error);
    communicator.abort(exit_status_of(error));
  }
  return 0;
}
