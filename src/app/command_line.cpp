#include "app/command_line.hpp"

#include <algorithm>
#include <vector>

#include "app/commands/commands.hpp"
#include "app/pages/pages.hpp"
#include "base/nearest_word.hpp"

namespace enfilade {

namespace {

constexpr const char* about =
    "Enfilade: the light in whole buildings, by parallel hierarchical radiosity.\n\n"
    "The usual way:  import (a model) -> solve (the light) -> rooms, walk, probe, render, export, "
    "report";

constexpr const char* examples =
    "Examples:\n"
    "  enfilade solve scenes/duplex.json -o out/duplex\n"
    "  mpirun -n 4 enfilade solve scenes/duplex.json -o out/duplex --target-error 0.02\n"
    "  enfilade rooms out/duplex -o rooms.html\n"
    "  enfilade render out/duplex -o living.png\n\n"
    "Each subcommand explains itself: enfilade solve --help\n"
    "Lengths are metres. Light is W/m2, or lm/m2 (lux) where the scene says so.\n"
    "Exit status: 0 done, 1 the run failed, 2 the input or the command line is wrong.";

std::vector<std::string> subcommand_names(const CLI::App& cli) {
  std::vector<std::string> names;
  for (const CLI::App* sub : cli.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(sub->get_name());
  }
  return names;
}

/// A first word that is no subcommand gets the list of them, and the one that it may have meant.
InputError unknown_subcommand(const std::vector<std::string>& names, const std::string& word) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  const std::string nearest = nearest_word(word, names);
  const std::string hint = nearest.empty() ? "" : "did you mean '" + nearest + "'? ";
  return InputError("command line", word, "no such subcommand", hint + "there are " + all);
}

InputError fault_of(const CLI::App& cli, const CLI::ParseError& error) {
  const auto chosen = cli.get_subcommands();
  const std::string name = chosen.empty() ? "" : chosen.front()->get_name();
  const std::string help = name.empty() ? "enfilade --help" : "enfilade " + name + " --help";
  return InputError("command line", name.empty() ? "subcommand" : name, on_one_line(error.what()),
                    "see '" + help + "'");
}

/// In the order in which `enfilade --help` lists them.
void add_subcommands(CLI::App& cli, Command& chosen,
                     const std::function<void(CLI::App&)>& add_solve) {
  add_generate(cli, chosen);
  add_import(cli, chosen);
  add_prepare(cli, chosen);
  add_solve(cli);
  add_probe(cli, chosen);
  add_rooms(cli, chosen);
  add_walk(cli, chosen);
  add_render(cli, chosen);
  add_export(cli, chosen);
  add_factors(cli, chosen);
  add_bounds(cli, chosen);
  add_locate(cli, chosen);
  add_plan(cli, chosen);
  add_report(cli, chosen);
  add_info(cli, chosen);
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv,
                               const std::function<void(CLI::App&)>& add_solve) {
  CommandLine line;
  CLI::App cli(about, "enfilade");
  cli.footer(examples);
  cli.set_version_flag("--version", "enfilade " ENFILADE_VERSION);
  cli.require_subcommand(1);
  cli.get_formatter()->column_width(32);
  add_subcommands(cli, line.command, add_solve);
  const auto names = subcommand_names(cli);
  if (argc > 1 && argv[1][0] != '-' && std::ranges::find(names, argv[1]) == names.end()) {
    line.fault = unknown_subcommand(names, argv[1]);
    return line;
  }
  try {
    cli.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    line.text = std::string(version.what()) + "\n";
  } catch (const CLI::Success&) {
    line.text = cli.help();
  } catch (const CLI::ParseError& error) {
    line.fault = fault_of(cli, error);
  } catch (const InputError& error) {
    line.fault = error;
  }
  return line;
}

int run(const CommandLine& line, Session& session) {
  if (line.fault) {
    session.console().error(line.fault->what());
    return bad_input_status;
  }
  try {
    session.console().print(line.text);
    if (line.command && session.root()) line.command(session.console());
    return 0;
  } catch (const std::exception& error) {
    return session.fail(error);
  }
}

}  // namespace enfilade
