// A subcommand: what it takes on the command line, and what it does.
#pragma once

#include <functional>
#include <string>

#include "app/session.hpp"

namespace CLI {
class App;
}

namespace enfilade {

/// What a parsed command line asks for.
struct Command {
  bool on_every_rank = false;  ///< false: one rank works, the others have nothing to do
  std::function<void(Session&)> run;
};

/// Each adds one subcommand to `cli`; parsing it fills `chosen`. One file a subcommand:
/// command_<name>.cpp.
void add_generate(CLI::App& cli, Command& chosen);
void add_import(CLI::App& cli, Command& chosen);
void add_prepare(CLI::App& cli, Command& chosen);
void add_solve(CLI::App& cli, Command& chosen);
void add_probe(CLI::App& cli, Command& chosen);
void add_render(CLI::App& cli, Command& chosen);
void add_export(CLI::App& cli, Command& chosen);
void add_locate(CLI::App& cli, Command& chosen);
void add_plan(CLI::App& cli, Command& chosen);
void add_report(CLI::App& cli, Command& chosen);
void add_info(CLI::App& cli, Command& chosen);

}  // namespace enfilade
