// enfilade report: one self-contained page about one run or several.
#include <filesystem>

#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "app/outputs/run_outputs.hpp"
#include "app/outputs/solved_run.hpp"
#include "app/pages/pages.hpp"
#include "base/atomic_file.hpp"
#include "base/error.hpp"
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
    "that the solve has made are taken as they are. Where RUN has no walk.html (the building to "
    "walk\n"
    "through in a browser), that is made as well, and the page leads to it."};

struct ReportOptions {
  std::vector<std::string> runs;
  std::string output;
  bool pictures = true, rooms = true, walk = true;
};

/// Makes RUN/walk.html unless it is there, and a link to it in the page; says what came of it.
std::string add_walk_page(const RunOutputs& outputs, const SolvedRun& run, RunRooms& rooms,
                          const std::string& report, RunPage& page) {
  namespace fs = std::filesystem;
  const fs::path path = fs::path(outputs.run_directory) / "walk.html";
  try {
    if (!fs::exists(path) &&
        !write_walk_page(outputs, run, rooms, outputs.rooms ? &page.rooms : nullptr))
      return "none: this Enfilade was built without three.js; install npm and build it again";
  } catch (const RunError& error) {
    return std::string("none: ") + error.what() + "; use 'enfilade walk -o FILE'";
  }
  page.walk =
      fs::absolute(path).lexically_relative(fs::absolute(report).parent_path()).generic_string();
  return path.string();
}

void run_report(const ReportOptions& options, const Console& console) {
  check_output_file(options.output);
  std::vector<RunPage> pages;
  TextTable table(options.output);
  for (const std::string& directory : options.runs) {
    RunLock lock;
    lock.read(directory);
    const SolvedRun run(directory);
    const RunOutputs outputs{directory, options.pictures, options.rooms,
                             options.pictures && options.walk};
    RunRooms rooms(run);
    pages.push_back(make_run_page(outputs, run, rooms, console.progress()));
    if (outputs.walk)
      table.add("walk", add_walk_page(outputs, run, rooms, options.output, pages.back()));
  }
  const std::string html = report_html(pages);
  write_file_atomically(options.output, html);
  table.add("runs", with_thousands(pages.size()));
  table.add("size", format_bytes(static_cast<double>(html.size())));
  console.print(table.text());
}

void add_options(CLI::App& sub, ReportOptions& o) {
  sub.add_option("runs", o.runs, "RUN directories that solve has filled")->required();
  sub.add_option("-o,--output", o.output, "HTML file to write; it needs no other file")->required();
  sub.add_flag("!--no-pictures", o.pictures, "Plans and tables alone, and no walk.html");
  sub.add_flag("!--no-walk", o.walk,
               "Make no walk.html in RUN, the building to walk through in a browser");
  sub.add_flag("!--no-rooms", o.rooms,
               "Leave out the table of rooms, which takes most of the time");
}

}  // namespace

void add_report(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, report_help, add_options, run_report);
}

}  // namespace enfilade
