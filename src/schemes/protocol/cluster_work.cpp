#include "schemes/protocol/cluster_work.hpp"

#include <algorithm>

namespace enfilade {
namespace {

/// Operations between two looks at the messages: a fraction of a second today, half a minute in
/// 1998.
constexpr std::uint64_t operations_a_part = 512;
constexpr std::uint64_t most_parts = 256;

std::uint64_t parts_of(const WorkCount& work) {
  const std::uint64_t operations = work.rays + work.shafts + work.form_factors / 8;
  return 1 + std::min(most_parts - 1, operations / operations_a_part);
}

/// The k-th of n parts, counted from 0; all together are the whole.
WorkCount part(const WorkCount& work, std::uint64_t k, std::uint64_t n) {
  const auto share = [k, n](std::uint64_t count) { return count * (k + 1) / n - count * k / n; };
  return {share(work.rays),          share(work.form_factors),   share(work.kernels),
          share(work.links_refined), share(work.links_gathered), share(work.patches),
          share(work.push_pulls),    share(work.shafts)};
}

}  // namespace

void ClusterWork::spend(Machine& machine, const WorkCount& work) const {
  const std::uint64_t parts = machine.simulated() && listener_ ? parts_of(work) : 1;
  for (std::uint64_t k = 0; k < parts; ++k) {
    machine.compute(part(work, k, parts));
    listen();
  }
}

}  // namespace enfilade
