// enfilade locate: the cell that each of many points lies in.
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/commands/point_file.hpp"
#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "base/atomic_file.hpp"
#include "run/prepare.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText locate_help{
    "locate", "Say which cell each point lies in",
    "Example:\n  enfilade locate out/duplex --points points.json -o cells.json\n\n"
    "points.json is {\"points\": [[x,y,z], ...]} or a probe file {\"probes\": [{\"p\": [x,y,z]}, "
    "...]}.\n"
    "The answers stand in the points' order. The outside is a cell as well, where a surface or a "
    "portal\nlies at it; -1 is in no cell: inside of a solid, or in an outside that nothing "
    "sees."};

struct LocateOptions {
  std::string run, points, output;
};

void run_locate(const LocateOptions& options, const Console& console) {
  check_output_file(options.output);
  RunLock lock;
  lock.read(options.run);
  const Prepared prepared = load_prepared(options.run);
  nlohmann::json cells = nlohmann::json::array();
  std::size_t outside = 0, none = 0;
  for (const Vec3& p : read_points(options.points)) {
    const CellId cell = prepared.cells.locate(p);
    cells.push_back(cell.valid() ? static_cast<std::int64_t>(cell.value) : -1);
    if (!cell.valid()) {
      ++none;
    } else if (prepared.cells.cells()[cell.index()].kind == CellKind::outside) {
      ++outside;
    }
  }
  write_file_atomically(options.output, nlohmann::json{{"cells", cells}}.dump() + "\n");
  TextTable table(options.output);
  table.add("points", with_thousands(cells.size()));
  table.add("outside", with_thousands(outside));
  table.add("in no cell", with_thousands(none));
  console.print(table.text());
}

void add_options(CLI::App& sub, LocateOptions& o) {
  sub.add_option("run", o.run, "RUN directory, prepared or solved")->required();
  sub.add_option("--points", o.points, "Points file (JSON), metres unless it names \"units\"")
      ->required();
  sub.add_option("-o,--output", o.output, "File to write: {\"cells\": [id, ...]}")->required();
}

}  // namespace

void add_locate(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, locate_help, add_options, run_locate);
}

}  // namespace enfilade
