#include "linear_system_work.hpp"

#include <cmath>
#include <cstring>

#include "base/posix_file.hpp"
#include "base/random.hpp"

namespace enfilade::spmd_tests {
namespace {

std::vector<double> doubles(std::span<const std::byte> bytes) {
  std::vector<double> values(bytes.size() / sizeof(double));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
  return values;
}

constexpr int most_ranks = 64;

SegmentKind patches_of(int iteration) {
  return {RunLayout::patches(RunLayout::slot_of(iteration)), Section::patches,
          static_cast<std::uint32_t>(iteration), 0};
}

RecordCount record_of(std::size_t values) {
  RecordCount count;
  count.patches = values;
  count.bytes = values * sizeof(double);
  return count;
}

}  // namespace

LinearSystem::LinearSystem(std::size_t block_count, std::size_t size_of_block, double reflectance,
                           std::uint64_t seed)
    : blocks(block_count), block_size(size_of_block) {
  Random random(seed);
  const std::size_t n = blocks * block_size;
  matrix.assign(n * n, 0.0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = 0; i < blocks; ++i) {
    for (std::uint32_t j = i + 1; j < blocks; ++j) {
      if (j == i + 1 || random.uniform() < 0.3) pairs.emplace_back(i, j);
    }
  }
  graph = ClusterGraph(blocks, pairs);
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      const bool coupled =
          i / block_size == j / block_size || graph.has_edge(i / block_size, j / block_size);
      if (i == j || !coupled) continue;
      sum += matrix[i * n + j] = random.uniform();
    }
    for (std::size_t j = 0; j < n; ++j) matrix[i * n + j] *= reflectance / sum;
    b.push_back(random.uniform());
  }
}

std::vector<double> LinearSystem::solve_directly() const {
  const std::size_t n = size();
  std::vector<double> a(n * n), x = b;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) a[i * n + j] = (i == j ? 1.0 : 0.0) - m(i, j);
  }
  for (std::size_t k = 0; k < n; ++k) {  // diagonally dominant: no pivoting needed
    for (std::size_t i = k + 1; i < n; ++i) {
      const double f = a[i * n + k] / a[k * n + k];
      for (std::size_t j = k; j < n; ++j) a[i * n + j] -= f * a[k * n + j];
      x[i] -= f * x[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) x[k] -= a[k * n + j] * x[j];
    x[k] /= a[k * n + k];
  }
  return x;
}

LinearSystemWork::LinearSystemWork(const LinearSystem& system, const RunLayout& layout, Rank rank,
                                   Machine& machine, Labour labour)
    : system_(system),
      layout_(layout),
      machine_(machine),
      store_(layout, 0, rank, most_ranks, system.blocks, machine),
      labour_(std::move(labour)) {}

void LinearSystemWork::initialise() {
  remove_directory(layout_.common());
  make_directory(layout_.common());
  SegmentWriter writer(layout_.common(), patches_of(0), Rank{0});
  for (std::size_t i = 0; i < system_.blocks; ++i) {
    const ClusterId id(i);
    const std::span<const double> b(system_.b.data() + i * system_.block_size, system_.block_size);
    writer.put({{id, Section::patches}, {}, record_of(b.size())}, std::as_bytes(b));
  }
  writer.end();
  commit({}, {}, false);
}

std::vector<double> LinearSystemWork::values(ClusterId id) {
  return doubles(store_.load_section({id, Section::patches}).bytes);
}

IterationFigures LinearSystemWork::gather(ClusterId receiver) {
  if (labour_) labour_(receiver);
  const std::size_t size = system_.block_size, first = receiver.index() * size;
  std::vector<double> x(system_.size(), 0.0);
  const auto load = [&](std::size_t block) {
    const std::vector<double> v = values(ClusterId(block));
    std::copy(v.begin(), v.end(), x.begin() + static_cast<std::ptrdiff_t>(block * size));
  };
  load(receiver.index());
  for (const std::uint32_t n : system_.graph.neighbours(receiver.index())) load(n);

  IterationFigures figures;
  for (std::size_t i = first; i < first + size; ++i) {
    double value = system_.b[i];
    for (std::size_t j = 0; j < x.size(); ++j) value += system_.m(i, j) * x[j];
    figures.max_change = std::max(figures.max_change, std::abs(value - x[i]));
    figures.change_power += std::abs(value - x[i]);
    figures.received_power += value;
    x[i] = value;
  }
  figures.patches = size;
  figures.work.kernels = size * x.size();
  machine_.compute(figures.work);
  const auto block = std::as_bytes(std::span(x.data() + first, size));
  store_.store_sections(
      {{{{receiver, Section::patches}, {}, record_of(size)}, {block.begin(), block.end()}}});
  gathered_.push_back(receiver);
  return figures;
}

void LinearSystemWork::commit(const std::vector<IterationSummary>& history, std::span<const double>,
                              bool finished) {
  Manifest manifest;
  manifest.iteration = history.empty() ? 0 : history.back().plan.iteration;
  manifest.clusters = system_.blocks;
  manifest.finished = finished;
  for (const IterationSummary& summary : history) manifest.history.push_back(to_numbers(summary));
  commit_manifest(layout_, manifest);
}

std::vector<double> LinearSystemWork::committed(const LinearSystem& system,
                                                const RunLayout& layout) {
  const Manifest manifest = read_manifest(layout).value();
  const SegmentIndex index(layout.common(), patches_of(manifest.iteration), system.blocks,
                           most_ranks);
  std::vector<double> x;
  for (std::size_t i = 0; i < system.blocks; ++i) {
    const std::vector<double> v = doubles(index.read(ClusterId(i)).bytes);
    x.insert(x.end(), v.begin(), v.end());
  }
  return x;
}

}  // namespace enfilade::spmd_tests
