// enfilade-mpi and enfilade-smpi: all subcommands, on the ranks of the real or of the simulated
// machine. The two executables differ in the libraries that they link.
#include "app/command_line.hpp"
#include "app/solve/command_solve.hpp"

int main(int argc, char** argv) {
  using namespace enfilade;
  RankCommand solve;
  const CommandLine line =
      parse_command_line(argc, argv, [&solve](CLI::App& cli) { add_solve(cli, solve); });
  RankSession session(argc, argv, solve != nullptr);
  if (!solve) return run(line, session);
  try {
    solve(session);
    return 0;
  } catch (const std::exception& error) {
    return session.fail(error);
  }
}
