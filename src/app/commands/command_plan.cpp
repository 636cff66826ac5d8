// enfilade plan: plans of the storeys, with cells and portals, the clusters visible from one cell,
// or the ranks' clusters.
#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "app/commands/commands.hpp"
#include "app/frame/option_checks.hpp"
#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "app/outputs/plan_files.hpp"
#include "assignment/assignment.hpp"
#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "report/plans/plan_leaks.hpp"
#include "run/leak_file.hpp"
#include "run/prepare.hpp"
#include "run/stats_json.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText plan_help{
    "plan", "Draw plans of the storeys: cells and portals, what a cell sees, the ranks' shares",
    "Examples:\n  enfilade plan out/duplex -o plan.svg\n"
    "  enfilade plan out/duplex -o seen.png --storey 1 --visible-from 3\n"
    "  enfilade plan out/duplex -o shares.svg --ranks 8 --assignment metis\n\n"
    "Areas are where a level cut meets the cells, exactly; in the SVG the map is in metres, and "
    "every\ncell, cluster and portal says its number under the mouse."};

struct PlanOptions {
  std::string run, output, show, visible_from;
  int storey = 0, ranks = 0;
  std::string assignment = "kmeans";
  std::uint64_t seed = AssignmentConfig{}.seed;
  FloorPlanConfig plan;

  /// --show, or the subject that the other options imply.
  std::string subject() const {
    if (!show.empty()) return show;
    if (!visible_from.empty()) return "visible";
    return ranks > 0 ? "assignment" : "cells";
  }
};

InputError wrong(const char* option, const std::string& what, const std::string& hint) {
  return {"command line", option, what, hint};
}

void check(const PlanOptions& options) {
  const std::string subject = options.subject();
  if (!options.output.ends_with(".svg") && !options.output.ends_with(".png")) {
    throw wrong("-o", "'" + options.output + "' is neither .svg nor .png",
                "name a .svg or a .png file");
  }
  if (subject == "visible" && options.visible_from.empty())
    throw wrong("--show", "visible from where?", "give --visible-from CELL or X,Y,Z as well");
  if (subject != "visible" && !options.visible_from.empty())
    throw wrong("--visible-from", "does not go with --show " + subject, "leave one of them out");
  if (subject != "assignment" && options.ranks > 0)
    throw wrong("--ranks", "does not go with --show " + subject, "leave one of them out");
  check_output_file(options.output);
}

/// Numbers between commas, all of the text; none where it is anything else.
std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  const char *at = text.data(), *end = at + text.size();
  while (true) {
    double number = 0.0;
    const auto [after, fault] = std::from_chars(at, end, number);
    if (fault != std::errc() || !std::isfinite(number)) return {};
    numbers.push_back(number);
    if (after == end) return numbers;
    if (*after != ',') return {};
    at = after + 1;
  }
}

/// "20, 22, 25, ...": the first rooms' cells.
std::string rooms_of(const CellComplex& complex) {
  constexpr int most = 8;
  std::string list;
  int listed = 0;
  for (const Cell& cell : complex.cells()) {
    if (cell.kind != CellKind::room) continue;
    if (listed == most) return list + ", ...";
    list += (listed++ == 0 ? "" : ", ") + std::to_string(cell.id.value);
  }
  return list;
}

CellId chosen_cell(const std::string& text, const CellComplex& complex) {
  const std::vector<double> numbers = numbers_of(text);
  if (numbers.size() == 3) {
    const CellId cell = complex.locate({numbers[0], numbers[1], numbers[2]});
    if (cell.valid()) return cell;
    throw wrong("--visible-from", "the point " + text + " lies in no cell",
                "name a point in a room, in metres");
  }
  const std::size_t count = complex.cells().size();
  const bool number = numbers.size() == 1 && numbers[0] >= 0.0 &&
                      numbers[0] < static_cast<double>(count) &&
                      numbers[0] == std::floor(numbers[0]);
  if (!number) {
    throw wrong("--visible-from", "'" + text + "' is no cell of this run",
                fmt::format("name a cell, such as {}, or a point X,Y,Z", rooms_of(complex)));
  }
  const auto cell = static_cast<std::size_t>(numbers[0]);
  if (complex.cells()[cell].kind == CellKind::solid) {
    throw wrong(
        "--visible-from", "cell " + text + " is the inside of a solid",
        "name one of " + rooms_of(complex) + "; 'enfilade plan RUN -o plan.svg' shows them");
  }
  return CellId(cell);
}

std::vector<Rank> chosen_owners(const PlanOptions& options, const Prepared& prepared) {
  if (options.ranks > 0) {
    return assign_clusters(prepared.graph, prepared.clusters,
                           {.method = assignment_method(options.assignment),
                            .parts = options.ranks,
                            .seed = options.seed});
  }
  std::vector<Rank> owner = read_owners(options.run);
  if (owner.size() != prepared.clusters.size()) {
    throw InputError(options.run, "assignment.json", "the run is not solved",
                     "give --ranks P to compute an assignment, or solve the run first");
  }
  return owner;
}

PlanSubject chosen_subject(const PlanOptions& options, const PlannedBuilding& building,
                           Prepared& prepared, const Progress& progress) {
  const std::string subject = options.subject();
  if (subject == "assignment")
    return assignment_subject(building, chosen_owners(options, prepared));
  if (subject == "cells") return cells_subject(building);
  const CellId from = chosen_cell(options.visible_from, prepared.cells);
  find_visibility(prepared, {}, progress);
  return visible_subject(building,
                         visible_set(prepared.cells, prepared.clusters, prepared.graph, from));
}

void run_plan(const PlanOptions& options, const Console& console) {
  check(options);
  RunLock lock;
  lock.read(options.run);
  Prepared prepared = load_prepared(options.run);
  const Occluders occluders(prepared.clusters);
  const PlannedBuilding building{prepared.cells, prepared.clusters, occluders};
  const PlanSubject subject = chosen_subject(options, building, prepared, console.progress());
  const std::vector<Storey> all = storeys(building);
  const int count = static_cast<int>(all.size());
  if (options.storey > count) {
    throw wrong("--storey", fmt::format("there is no storey {}", options.storey),
                count == 1 ? "there is one storey" : fmt::format("choose one of 1 to {}", count));
  }
  const std::vector<Leak> leaks = read_leaks(options.run);
  TextTable table;
  for (int number = 1; number <= count; ++number) {
    if (options.storey != 0 && number != options.storey) continue;
    FloorPlan plan = floor_plan(building, all, number, subject, options.plan);
    draw_leaks(plan, all, leaks);
    const bool one = options.storey != 0 || count == 1;
    const std::string path = one ? options.output : numbered_path(options.output, number);
    check_output_file(path);
    write_file_atomically(path, plan_content(plan, path));
    table.add(path, plan.title);
  }
  table.add("shown", subject.subtitle);
  console.print(table.text());
}

void add_subject_options(CLI::App& sub, PlanOptions& o) {
  sub.add_option("--show", o.show,
                 "What the colours say: cells, visible or assignment; default: cells, or what "
                 "--visible-from or --ranks asks for")
      ->check(CLI::IsMember({"cells", "visible", "assignment"}));
  sub.add_option("--visible-from", o.visible_from,
                 "What this cell sees: its number, or a point X,Y,Z in it (metres)");
  sub.add_option("--ranks", o.ranks,
                 "Compute an assignment to so many ranks; default: that of the solve")
      ->check(CLI::Range(1, 1000000));
  sub.add_option("--assignment", o.assignment, "How: kmeans, metis, greedy or round-robin")
      ->check(CLI::IsMember(
          std::vector<std::string>(assignment_names().begin(), assignment_names().end())))
      ->needs("--ranks")
      ->capture_default_str();
  sub.add_option("--seed", o.seed, "Of kmeans and metis")
      ->needs("--ranks")
      ->check(whole_number())
      ->capture_default_str();
}

void add_options(CLI::App& sub, PlanOptions& o) {
  sub.add_option("run", o.run, "RUN directory, prepared or solved")->required();
  sub.add_option("-o,--output", o.output,
                 "File to write, .svg or .png; with several storeys plan.svg becomes plan-1.svg, "
                 "plan-2.svg ...")
      ->required();
  sub.add_option("--storey", o.storey, "Only this one, the lowest is 1; default: all")
      ->check(CLI::Range(1, 1000000));
  sub.add_option("--cut", o.plan.cut_m,
                 "Height of the cut above the storey's floor, metres (at most 45% of the "
                 "storey's height)")
      ->check(positive_number())
      ->capture_default_str();
  add_subject_options(sub, o);
}

}  // namespace

void add_plan(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, plan_help, add_options, run_plan);
}

}  // namespace enfilade
