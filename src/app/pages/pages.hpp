// The subcommands that make pictures and pages of a solved RUN. Each adds itself to the command
// line; parsing that fills `chosen`. One file each: command_<name>.cpp.
#pragma once

#include "app/frame/subcommand.hpp"

namespace enfilade {

void add_walk(CLI::App& cli, Command& chosen);
void add_render(CLI::App& cli, Command& chosen);
void add_report(CLI::App& cli, Command& chosen);

}  // namespace enfilade
