// enfilade report: one self-contained page about one run or several.
#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "app/outputs/run_outputs.hpp"
#include "app/outputs/solved_run.hpp"
#include "app/pages/pages.hpp"
#include "base/atomic_file.hpp"
#include "report/page/html_report.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText report_help{
    "report", "Make one page about one run, or about several side by side",
    "Example:\n  enfilade report out/fine out/coarse -o compare.html\n\n"
    "The page begins with the light in each room (as 'enfilade rooms' finds it, without "
    "cylindrical\n"
    "illuminance). Pictures, plans coloured by rank, the error over the iterations, and where the "
    "time\n"
    "went on each rank follow. With several runs a table that compares them comes first. Pictures\n"
    "that the solve has made are taken as they are."};

struct ReportOptions {
  std::vector<std::string> runs;
  std::string output;
  bool pictures = true, rooms = true;
};

void run_report(const ReportOptions& options, const Console& console) {
  check_output_file(options.output);
  std::vector<RunPage> pages;
  for (const std::string& directory : options.runs) {
    RunLock lock;
    lock.read(directory);
    const SolvedRun run(directory);
    pages.push_back(make_run_page({directory, options.pictures, options.rooms, false}, run,
                                  console.progress()));
  }
  const std::string html = report_html(pages);
  write_file_atomically(options.output, html);
  TextTable table(options.output);
  table.add("runs", with_thousands(pages.size()));
  table.add("size", format_bytes(static_cast<double>(html.size())));
  console.print(table.text());
}

void add_options(CLI::App& sub, ReportOptions& o) {
  sub.add_option("runs", o.runs, "RUN directories that solve has filled")->required();
  sub.add_option("-o,--output", o.output, "HTML file to write; it needs no other file")->required();
  sub.add_flag("!--no-pictures", o.pictures, "Plans and tables alone");
  sub.add_flag("!--no-rooms", o.rooms,
               "Leave out the table of rooms, which takes most of the time");
}

}  // namespace

void add_report(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, report_help, add_options, run_report);
}

}  // namespace enfilade
