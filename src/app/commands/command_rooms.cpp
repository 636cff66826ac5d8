// enfilade rooms: the light in each room of the building, as a table.
#include <fmt/format.h>

#include <filesystem>

#include "app/commands/commands.hpp"
#include "app/commands/glare_place_file.hpp"
#include "app/frame/option_checks.hpp"
#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "app/outputs/room_survey.hpp"
#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "report/page/html_report.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText rooms_help{
    "rooms", "Say how much light each room has, as a table",
    "Example:\n  enfilade rooms out/duplex -o rooms.html --maintenance-factor 0.8\n\n"
    "Rooms are those that the scene file names (\"rooms\"; import fills them from an IFC model's\n"
    "spaces), else the cells that the preparation found. Illuminance is taken on the grid of\n"
    "EN 12464-1: points are 0.2 * 5^log10(d) m apart, d being the room's longer side, and a band "
    "of\n"
    "0.5 m along the walls is left out (15% of the shorter side where that is less). Points "
    "within\n"
    "furniture or without the room's floor below are left out and counted.\n\n"
    "The table has, for each room, mean, minimum, maximum, uniformity U0 (minimum by mean), the "
    "mean\n"
    "on walls and ceiling, the mean cylindrical illuminance, what the file asks for, and whether "
    "it is\n"
    "met; error is one standard deviation of the mean, everything counted. rooms.html has the "
    "same,\n"
    "sortable, and a plan of each room in false colour with isolux lines. Where a sky without sun "
    "is\n"
    "the only light, daylight factors (mean, minimum, median; percent) follow.\n\n"
    "places.json for --ugr-at is {\"places\": [{\"name\": \"desk\", \"p\": [x,y,z], \"direction\": "
    "[x,y,z]}]};\n"
    "each gets its UGR (CIE 117) in a second file, rooms-ugr.csv, and in the page."};

struct RoomsOptions {
  std::string run, output, places;
  RunLight light;
  RunSurvey how;
};

bool is_page(const std::string& path) { return path.ends_with(".html"); }

void check_options(const RoomsOptions& options) {
  check_output_file(options.output);
  if (!is_page(options.output) && !options.output.ends_with(".csv"))
    throw InputError(options.output, "-o", "is neither a table nor a page",
                     "let it end in .csv or .html");
}

void refuse_watts(const SolvedRun& run, const std::string& directory) {
  if (run.prepared().scene.unit == ExitanceUnit::lumen_per_m2) return;
  throw InputError(directory + "/scene.json", "exitanceUnits",
                   "is W/m2, and UGR is a rating of luminances",
                   "leave --ugr-at out, or solve a scene in lm/m2");
}

/// "out/rooms.csv" -> "out/rooms-ugr.csv".
std::string glare_file(const std::string& path) {
  const std::filesystem::path whole(path);
  return (whole.parent_path() / (whole.stem().string() + "-ugr.csv")).string();
}

std::string page_of(const RoomTable& table, const std::string& run) {
  std::filesystem::path directory = std::filesystem::path(run).lexically_normal();
  if (!directory.has_filename()) directory = directory.parent_path();
  return html_page("Rooms of " + directory.filename().string(), rooms_html(table));
}

void print_summary(const RoomsOptions& options, const RoomTable& table, const Console& console) {
  std::size_t points = 0, left_out = 0, asked = 0, met = 0, unsure = 0;
  for (const RoomFigures& room : table.rooms) {
    points += room.values.size();
    left_out += room.in_furniture + room.without_floor;
    const Verdict verdict = verdict_of(room);
    asked += verdict != Verdict::none_asked;
    met += verdict == Verdict::met;
    unsure += verdict == Verdict::within_error;
  }
  TextTable text(options.output);
  text.add("rooms", with_thousands(table.rooms.size()));
  text.add("points", with_thousands(points));
  if (left_out > 0)
    text.add("left out", with_thousands(left_out) + " in furniture, or without a floor below");
  text.add("unit", table.unit);
  if (!table.weights.empty()) text.add("bands as one", table.weights);
  text.add("maintenance", fmt::format("factor {:g}", table.maintenance_factor));
  if (table.outside > 0.0)
    text.add("outside", fmt::format("{:.5g} {}, for daylight factors", table.outside, table.unit));
  if (!table.no_daylight_factor.empty())
    text.add("daylight factors", "none: " + table.no_daylight_factor);
  if (asked > 0)
    text.add("asked light",
             fmt::format("met in {} of {} rooms, within the error in {}", met, asked, unsure));
  if (!table.glare.empty()) text.add("UGR", glare_file(options.output));
  console.print(text.text());
}

void run_rooms(const RoomsOptions& options, const Console& console) {
  check_options(options);
  std::vector<GlarePlace> places;
  if (!options.places.empty()) places = read_glare_places(options.places);
  RunLock lock;
  lock.read(options.run);
  const SolvedRun run(options.run, {}, options.light);
  if (!places.empty()) refuse_watts(run, options.run);
  RunRooms rooms(run);
  const RoomTable table = survey_run(run, rooms, options.how, places, console.progress());
  if (table.rooms.empty()) {
    throw InputError(options.run, "rooms", "the scene names none, and no cell of it is a room",
                     "list them under \"rooms\" in the scene file, and solve it again");
  }
  write_file_atomically(options.output,
                        is_page(options.output) ? page_of(table, options.run) : rooms_csv(table));
  if (!places.empty()) write_file_atomically(glare_file(options.output), glare_csv(table));
  print_summary(options, table, console);
}

void add_options(CLI::App& sub, RoomsOptions& o) {
  sub.add_option("run", o.run, "RUN directory that solve has filled")->required();
  sub.add_option("-o,--output", o.output, "File to write: .csv for a table, .html for a page")
      ->required();
  add_switch_option(sub, o.light.switches);
  sub.add_option(
         "--height", o.how.survey.plane_m,
         "Height of the working plane above the floor, m; at most half of the room's height")
      ->check(number_from_zero())
      ->capture_default_str();
  sub.add_option("--cylindrical-height", o.how.survey.cylindrical_m,
                 "Height of the points of cylindrical illuminance above the floor, m")
      ->check(number_from_zero())
      ->capture_default_str();
  sub.add_flag("!--no-cylindrical", o.how.survey.cylindrical,
               "Leave cylindrical illuminance out, which takes most of the time");
  sub.add_option("--maintenance-factor", o.how.survey.maintenance_factor,
                 "All light is multiplied by it; 0.8 is usual, 1 is a new installation")
      ->check(number_between(0.0, 1.0 + 1e-9))
      ->capture_default_str();
  sub.add_option("--ugr-at", o.places, "File of places at which glare is rated (JSON)");
  sub.add_option("--rays", o.how.gather.rays, "Rays over the hemisphere of each point, at first")
      ->check(CLI::Range(4, 100000000))
      ->capture_default_str();
  sub.add_option("--noise", o.how.gather.noise,
                 "More rays, up to 16 times as many, where their noise is above this share of a "
                 "point's light (0: never; default: 0.02)")
      ->check(share_of_one());
  sub.add_option("--seed", o.how.gather.seed, "Seed of the rays")
      ->check(whole_number())
      ->capture_default_str();
}

}  // namespace

void add_rooms(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, rooms_help, add_options, run_rooms);
}

}  // namespace enfilade
