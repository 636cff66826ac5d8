// enfilade: every subcommand but `solve`, without MPI; `solve` and the ranks of a launcher are left
// to enfilade-mpi.
#include "app/command_line.hpp"
#include "app/enfilade_mpi.hpp"
#include "app/frame/solve_name.hpp"

int main(int argc, char** argv) {
  using namespace enfilade;
  Session session;
  try {
    if (needs_mpi(argc, argv)) become_enfilade_mpi(argv);
  } catch (const std::exception& error) {
    return session.fail(error);
  }
  const CommandLine line = parse_command_line(
      argc, argv, [](CLI::App& cli) { cli.add_subcommand(solve_name, solve_description); });
  return run(line, session);
}
