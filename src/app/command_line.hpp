// The command line: subcommands, their options, and one line for whatever is wrong with them.
#pragma once

#include <optional>
#include <string>

#include "app/command.hpp"
#include "base/error.hpp"

namespace enfilade {

/// What the arguments come to: a command to run, a text to show (--help, --version), or a fault.
struct CommandLine {
  Command command;
  std::string text;
  std::optional<InputError> fault;
};

/// Never throws and prints nothing.
CommandLine parse_command_line(int argc, const char* const* argv);

/// Does what the line asks for, prints what goes wrong, and gives the exit status: 0, 1 or 2.
int run(const CommandLine& line, Session& session);

}  // namespace enfilade
