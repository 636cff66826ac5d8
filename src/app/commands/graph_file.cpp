#include "app/commands/graph_file.hpp"

#include <fmt/format.h>

#include <iterator>
#include <set>

namespace enfilade {

std::string graph_json(const Prepared& prepared) {
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "{{\"clusters\": [");
  const char* separator = "\n";
  for (const Cluster& cluster : prepared.clusters) {
    std::set<std::uint32_t> surfaces;
    for (const ClusterPolygon& polygon : cluster.polygons) surfaces.insert(polygon.surface.value);
    const std::int64_t cell =
        cluster.cell.valid() ? static_cast<std::int64_t>(cluster.cell.value) : -1;
    fmt::format_to(to, "{}{{\"id\": {}, \"cell\": {}, \"surfaces\": [{}]}}", separator,
                   cluster.id.value, cell, fmt::join(surfaces, ","));
    separator = ",\n";
  }
  fmt::format_to(to, "\n],\n\"visible\": [");
  separator = "\n";
  for (std::size_t i = 0; i < prepared.graph.size(); ++i) {
    for (const std::uint32_t j : prepared.graph.neighbours(i)) {
      if (j <= i) continue;
      fmt::format_to(to, "{}[{},{}]", separator, i, j);
      separator = ",\n";
    }
  }
  fmt::format_to(to, "\n]}}\n");
  return fmt::to_string(out);
}

}  // namespace enfilade
