// enfilade walk: a page to walk through a solved building.
#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "app/outputs/room_survey.hpp"
#include "app/outputs/walk_file.hpp"
#include "app/pages/pages.hpp"
#include "base/atomic_file.hpp"
#include "base/error.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText walk_help{
    "walk", "Make a page to walk through the building in a browser",
    "Example:\n  enfilade walk out/duplex -o walk.html --rooms\n\n"
    "The page needs no other file and no network: open it in a browser (WebGL 2, any of 2023 or "
    "later).\n"
    "It shows the building in light and in false colour with a legend, and the illuminance and "
    "luminance\n"
    "under the pointer; a click on a room, in the table, the plan or the overview, takes you there "
    "at eye\n"
    "height. Keys and touch are explained in the page. The light is that of the solution's "
    "patches, "
    "kept to\n"
    "0.05%; `probe --from patches` tells the same values, `probe` more accurate ones.\n\n"
    "Where RUN has shares (solve --shares), each luminaire or switch can be dimmed.\n\n"
    "`solve` makes it as RUN/walk.html. Building Enfilade needs npm for it, which fetches "
    "three.js."};

struct WalkOptions {
  std::string run, output;
  bool rooms = false;
};

void run_walk(const WalkOptions& options, const Console& console) {
  check_output_file(options.output);
  if (!options.output.ends_with(".html"))
    throw InputError(options.output, "-o", "is no page", "let it end in .html");
  const std::optional<std::string> program = walk_program();
  if (!program) {
    throw InputError("command line", "walk", "this Enfilade was built without three.js",
                     "install npm (apt-get install nodejs npm), then configure and build it again");
  }
  RunLock lock;
  lock.read(options.run);
  const SolvedRun run(options.run);
  RunRooms rooms(run);
  RoomTable figures;
  if (options.rooms)
    figures = survey_run(run, rooms, {.survey = {.cylindrical = false}}, {}, console.progress());
  const std::string page =
      walk_page(run, rooms, options.run, options.rooms ? &figures : nullptr, *program);
  write_file_atomically(options.output, page);
  TextTable table(options.output);
  table.add("size", format_bytes(static_cast<double>(page.size())));
  console.print(table.text());
}

void add_options(CLI::App& sub, WalkOptions& o) {
  sub.add_option("run", o.run, "RUN directory that solve has filled")->required();
  sub.add_option("-o,--output", o.output, "HTML file to write; it needs no other file")->required();
  sub.add_flag("--rooms", o.rooms,
               "With the illuminance of each room's working plane, as 'enfilade rooms' finds it; "
               "takes most of the time");
}

}  // namespace

void add_walk(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, walk_help, add_options, run_walk);
}

}  // namespace enfilade
