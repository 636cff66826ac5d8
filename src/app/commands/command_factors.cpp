// enfilade factors: view factors between the surfaces of a scene, for programs of heat radiation.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "app/commands/commands.hpp"
#include "app/frame/option_checks.hpp"
#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "report/survey/building_rooms.hpp"
#include "run/prepare.hpp"
#include "view_factors/view_factor_files.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText factors_help{
    "factors", "Write the view factors between surfaces, for EnergyPlus, MOOSE and others",
    "Example:\n  enfilade factors out/room -o view-factors.idf --zone \"Office 1\"\n\n"
    "The file's ending says its form: .csv, a line a pair; .idf, EnergyPlus's\n"
    "ZoneProperty:UserViewFactors:BySurfaceName; .i, the boundary and view_factors of MOOSE's\n"
    "ConstantViewFactorSurfaceRadiation. RUN need only be prepared. Factors are closed forms with\n"
    "visibility, integrated over each surface; above 300 polygons they are found by rays. They "
    "are\n"
    "reciprocal (A_i F_ij = A_j F_ji), and rows of closed enclosures sum to 1: the file says what\n"
    "they summed to before. Surfaces face one side; a two-sided one counts with both, and what a "
    "body\n"
    "covers that stands on a surface does not count."};

/// More groups than these make a matrix that no one reads; more polygons make the quadrature slow.
constexpr std::size_t most_groups = 2000, most_exact_polygons = 300;
constexpr int usual_rays = 100000;

struct FactorsOptions {
  std::string run, output, by = "surface", zone;
  double error = ViewFactorConfig{}.error;
  int rays = 0;
  std::uint64_t seed = 1;
};

bool ends_in(const std::string& path, const char* ending) { return path.ends_with(ending); }

void check_options(const FactorsOptions& options) {
  check_output_file(options.output);
  const std::string& path = options.output;
  if (!ends_in(path, ".csv") && !ends_in(path, ".idf") && !ends_in(path, ".i"))
    throw InputError(path, "-o", "is no form of view factors", "let it end in .csv, .idf or .i");
}

/// Numbers the groups in the order in which their names come.
class GroupMaker {
 public:
  explicit GroupMaker(std::size_t polygons) {
    groups_.of_polygon.assign(polygons, ViewFactorGroups::none);
  }
  void put(std::uint32_t polygon, const std::string& key, const std::string& name) {
    const auto [it, added] = numbers_.try_emplace(key, groups_.names.size());
    if (added) groups_.names.push_back(name);
    groups_.of_polygon[polygon] = static_cast<std::uint32_t>(it->second);
  }
  ViewFactorGroups take() { return std::move(groups_); }

 private:
  ViewFactorGroups groups_;
  std::map<std::string, std::size_t> numbers_;
};

/// The room before a polygon's front, by its number; none in no room.
const SurveyRoom* room_before(const std::vector<SurveyRoom>& rooms, const Polygon& polygon) {
  const double off_m = 0.02 * std::sqrt(area_m2(polygon));
  const Vec3 p = centroid(polygon) + off_m * normal(polygon);
  for (const SurveyRoom& room : rooms) {
    const double reach_m = 0.05 * room.height_m();
    if (p.z > room.floor_m - reach_m && p.z < room.ceiling_m + reach_m &&
        room.plan.contains(Vec2(p)))
      return &room;
  }
  return nullptr;
}

ViewFactorGroups groups_of(const FactorsOptions& options, const Prepared& run,
                           const Occluders& occluders) {
  std::size_t polygons = 0;
  for (const Cluster& cluster : run.clusters) polygons += cluster.polygons.size();
  std::vector<SurveyRoom> rooms;
  if (options.by == "room")
    rooms = rooms_of_building({run.cells, run.clusters, occluders}, run.scene.building.rooms);
  GroupMaker maker(polygons);
  for (const Cluster& cluster : run.clusters) {
    for (std::uint32_t k = 0; k < cluster.polygons.size(); ++k) {
      const SurfaceId id = cluster.polygons[k].surface;
      const Surface& surface = run.scene.surfaces[id.index()];
      const std::string number = "surface " + std::to_string(id.value);
      const std::uint32_t polygon = occluders.global(cluster.id, k);
      if (options.by == "room") {
        const SurveyRoom* room = room_before(rooms, occluders.polygon(polygon));
        const std::string name = room == nullptr ? "in no room" : room->name;
        maker.put(polygon, room == nullptr ? "" : std::to_string(room - rooms.data()), name);
      } else if (options.by == "object" && !surface.object.empty()) {
        maker.put(polygon, "o" + surface.object, surface.object);
      } else {
        maker.put(polygon, number, surface.name.empty() ? number : surface.name);
      }
    }
  }
  return maker.take();
}

std::string content_of(const FactorsOptions& options, const ViewFactors& factors) {
  if (ends_in(options.output, ".csv")) return view_factors_csv(factors);
  if (ends_in(options.output, ".i")) return view_factors_moose(factors);
  std::filesystem::path run = std::filesystem::path(options.run).lexically_normal();
  if (!run.has_filename()) run = run.parent_path();
  return view_factors_idf(factors, options.zone.empty() ? run.filename().string() : options.zone);
}

void run_factors(const FactorsOptions& options, const Console& console) {
  check_options(options);
  RunLock lock;
  lock.read(options.run);
  Prepared run = load_prepared(options.run);
  make_panes_opaque(run.clusters);
  const Occluders occluders(run.clusters);
  const ViewFactorGroups groups = groups_of(options, run, occluders);
  if (groups.names.size() > most_groups) {
    throw InputError(
        options.run, "--by " + options.by,
        fmt::format("{} would make {} view factors", with_thousands(groups.names.size()),
                    with_thousands(groups.names.size() * groups.names.size())),
        fmt::format("use --by object or --by room, for at most {}", with_thousands(most_groups)));
  }
  ViewFactorConfig config;
  config.error = options.error;
  config.seed = options.seed;
  const bool exact = groups.of_polygon.size() <= most_exact_polygons;
  config.rays = options.rays > 0 ? options.rays : exact ? 0 : usual_rays;
  const ViewFactors factors =
      view_factors(run.scene, run.clusters, occluders, groups, config, console.progress());
  write_file_atomically(options.output, content_of(options, factors));
  TextTable table(options.output);
  table.add("surfaces", with_thousands(factors.size()));
  table.add("found by", config.rays > 0 ? with_thousands(static_cast<std::uint64_t>(config.rays)) +
                                              " rays from each"
                                        : std::string("closed forms"));
  table.add("closed rows", with_thousands(static_cast<std::uint64_t>(
                               std::count(factors.closed.begin(), factors.closed.end(), true))) +
                               ", to sum to 1");
  table.add("closure", fmt::format("changes a factor by at most {:.2g}", factors.largest_closure));
  console.print(table.text());
}

void add_options(CLI::App& sub, FactorsOptions& o) {
  sub.add_option("run", o.run, "RUN directory that prepare or solve has filled")->required();
  sub.add_option("-o,--output", o.output, "File to write: .csv, .idf (EnergyPlus) or .i (MOOSE)")
      ->required();
  sub.add_option("--by", o.by, "Between what: each surface of the file, objects, or rooms")
      ->check(CLI::IsMember({"surface", "object", "room"}))
      ->capture_default_str();
  sub.add_option("--zone", o.zone, "Name of the zone or enclosure in an .idf; default: RUN's name");
  sub.add_option("--error", o.error, "Error of a row to reach, summed over its factors")
      ->check(number_between(0.0, 1.0))
      ->capture_default_str();
  sub.add_option("--rays", o.rays,
                 "So many rays from each surface in place of closed forms; default: 100000 above "
                 "300 polygons")
      ->check(CLI::Range(16, 1000000000));
  sub.add_option("--seed", o.seed, "Seed of the rays")
      ->check(whole_number())
      ->capture_default_str();
}

}  // namespace

void add_factors(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, factors_help, add_options, run_factors);
}

}  // namespace enfilade
