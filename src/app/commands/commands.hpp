// The subcommands that one process carries out. Each adds itself to the command line; parsing that
// fills `chosen`. One file each: command_<name>.cpp.
#pragma once

#include "app/frame/subcommand.hpp"

namespace enfilade {

void add_generate(CLI::App& cli, Command& chosen);
void add_import(CLI::App& cli, Command& chosen);
void add_prepare(CLI::App& cli, Command& chosen);
void add_probe(CLI::App& cli, Command& chosen);
void add_rooms(CLI::App& cli, Command& chosen);
void add_export(CLI::App& cli, Command& chosen);
void add_factors(CLI::App& cli, Command& chosen);
void add_bounds(CLI::App& cli, Command& chosen);
void add_locate(CLI::App& cli, Command& chosen);
void add_plan(CLI::App& cli, Command& chosen);
void add_info(CLI::App& cli, Command& chosen);

}  // namespace enfilade
