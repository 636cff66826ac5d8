// The command line of all executables: subcommands, help, and one line for each fault.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "app/frame/session.hpp"
#include "app/frame/subcommand.hpp"
#include "base/error.hpp"

namespace enfilade {

/// What the arguments come to: a command to run, a text to print (--help, --version), or a fault.
/// All of them are empty where the subcommand is one that the main adds by itself.
struct CommandLine {
  Command command;
  std::string text;
  std::optional<InputError> fault;
};

/// `add_solve` adds the subcommand `solve`, which executables without MPI only list. Prints and
/// throws nothing.
CommandLine parse_command_line(int argc, const char* const* argv,
                               const std::function<void(CLI::App&)>& add_solve);

/// Prints the text or the fault, or runs the command, on the process that is the session's root.
/// Returns the exit status: 0, 1 or 2.
int run(const CommandLine& line, Session& session);

}  // namespace enfilade
