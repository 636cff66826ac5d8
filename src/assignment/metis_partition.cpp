// The only file that calls METIS.
#include "assignment/metis_partition.hpp"

#include <metis.h>

#include <limits>
#include <string>

#include "base/error.hpp"

namespace enfilade {

std::vector<Rank> metis_parts(const ClusterGraph& graph, const AssignmentConfig& config) {
  const std::size_t n = graph.size();
  if (config.parts == 1) return std::vector<Rank>(n, Rank{0});
  if (2 * graph.edges() > static_cast<std::size_t>(std::numeric_limits<idx_t>::max())) {
    throw RunError("the visibility graph has " + std::to_string(graph.edges()) +
                   " edges, more than METIS was built for; use --assignment kmeans");
  }
  std::vector<idx_t> offsets{0}, targets, part(n, 0);
  targets.reserve(2 * graph.edges());
  for (std::size_t v = 0; v < n; ++v) {
    for (std::uint32_t to : graph.neighbours(v)) targets.push_back(static_cast<idx_t>(to));
    offsets.push_back(static_cast<idx_t>(targets.size()));
  }
  targets.push_back(0);  // METIS wants an address even where there are no edges
  idx_t nodes = static_cast<idx_t>(n), constraints = 1, parts = config.parts, cut = 0;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = static_cast<idx_t>(config.seed & 0x7FFFFFFFu);
  options[METIS_OPTION_NUMBERING] = 0;
  const int status =
      METIS_PartGraphKway(&nodes, &constraints, offsets.data(), targets.data(), nullptr, nullptr,
                          nullptr, &parts, nullptr, nullptr, options, &cut, part.data());
  if (status != METIS_OK) throw RunError("METIS failed with status " + std::to_string(status));
  std::vector<Rank> owner(n);
  for (std::size_t v = 0; v < n; ++v) owner[v] = Rank{static_cast<int>(part[v])};
  return owner;
}

}  // namespace enfilade
