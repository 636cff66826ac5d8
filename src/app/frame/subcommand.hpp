// Registers a subcommand: its name, its options, and what runs where the command line chose it.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>

#include "app/frame/console.hpp"

namespace enfilade {

/// What a command line chose, for one process; empty where it chose nothing.
using Command = std::function<void(const Console&)>;

struct SubcommandText {
  const char* name;
  const char* description;  ///< one line in `enfilade --help`
  const char* footer = "";  ///< stands below the options in `enfilade NAME --help`
};

/// Adds a subcommand to `cli`. `add_options` declares its options, which fill an Options object;
/// a command line that names the subcommand sets `chosen` to a call of `run` with that object.
/// `Context` is what the subcommand works with besides its options: the console, or the session of
/// all ranks. `chosen` must outlive the parsing.
template <class Options, class Context>
void add_subcommand(CLI::App& cli, std::function<void(Context)>& chosen, const SubcommandText& text,
                    void (*add_options)(CLI::App&, Options&),
                    void (*run)(const Options&, Context)) {
  auto options = std::make_shared<Options>();
  CLI::App* sub = cli.add_subcommand(text.name, text.description);
  add_options(*sub, *options);
  sub->footer(text.footer);
  sub->callback([options, run, &chosen] {
    chosen = [options, run](Context context) { run(*options, context); };
  });
}

/// Options that stand under one heading of a subcommand's help.
class OptionGroup {
 public:
  OptionGroup(CLI::App& sub, std::string heading) : sub_(sub), heading_(std::move(heading)) {}

  template <class T>
  CLI::Option* add(const std::string& name, T& value, const std::string& help) {
    return sub_.add_option(name, value, help)->group(heading_);
  }
  /// An option whose value `check` accepts, and whose default the help shows.
  template <class T>
  CLI::Option* add(const std::string& name, T& value, const std::string& help,
                   const CLI::Validator& check) {
    return add(name, value, help)->check(check)->capture_default_str();
  }
  CLI::Option* flag(const std::string& name, bool& value, const std::string& help) {
    return sub_.add_flag(name, value, help)->group(heading_);
  }

 private:
  CLI::App& sub_;
  std::string heading_;
};

}  // namespace enfilade
