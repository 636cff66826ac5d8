// enfilade and enfilade-smpi: the same main, linked with the real or with the simulated machine.
#include "app/command_line.hpp"
#include "app/session.hpp"

int main(int argc, char** argv) {
  const enfilade::CommandLine line = enfilade::parse_command_line(argc, argv);
  enfilade::Session session(argc, argv, line.command.on_every_rank);
  return enfilade::run(line, session);
}
