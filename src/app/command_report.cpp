// enfilade report: one self-contained page about one run or several.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command.hpp"
#include "app/output_file.hpp"
#include "app/run_outputs.hpp"
#include "app/solved_run.hpp"
#include "app/text_table.hpp"
#include "report/page/html_report.hpp"
#include "scene_file/scene_io.hpp"

namespace enfilade {

namespace {

struct ReportOptions {
  std::vector<std::string> runs;
  std::string output;
  bool pictures = true;
};

void run_report(const ReportOptions& options, Session& session) {
  check_output_file(options.output);
  std::vector<RunPage> pages;
  for (const std::string& directory : options.runs) {
    const SolvedRun run(directory);
    pages.push_back(make_run_page(directory, run.solved_scene(), options.pictures,
                                  session.console().progress()));
  }
  const std::string html = report_html(pages);
  write_file_atomically(options.output, html);
  TextTable table(options.output);
  table.add("runs", with_thousands(pages.size()));
  table.add("size", format_bytes(static_cast<double>(html.size())));
  session.console().print(table.text());
}

}  // namespace

void add_report(CLI::App& cli, Command& chosen) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* sub =
      cli.add_subcommand("report", "Make one page about one run, or about several side by side");
  sub->add_option("runs", options->runs, "RUN directories that solve has filled")->required();
  sub->add_option("-o,--output", options->output, "HTML file to write; it needs no other file")
      ->required();
  sub->add_flag("!--no-pictures", options->pictures, "Plans and tables alone");
  sub->footer(
      "Example:\n  enfilade report out/fine out/coarse -o compare.html\n\n"
      "The page has pictures, plans coloured by rank, the error over the iterations, and where the "
      "time\n"
      "went on each rank. With several runs a table that compares them comes first.");
  sub->callback([options, &chosen] {
    chosen = {false, [options](Session& session) { run_report(*options, session); }};
  });
}

}  // namespace enfilade
