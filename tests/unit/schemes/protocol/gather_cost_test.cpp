#include "schemes/protocol/gather_cost.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/random.hpp"
#include "run/manifest.hpp"
#include "run/run_mark.hpp"

namespace enfilade {
namespace {

constexpr std::uint64_t run_name = 7;
constexpr int iterations = 5;

/// A cluster as RUN has it before the first iteration.
ClusterState cluster(std::uint32_t id) {
  Scene scene;
  scene.bands = 1;
  Surface surface;
  surface.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  surface.reflectance = surface.exitance = {0.5};
  scene.surfaces = {surface};
  Cluster of_one;
  of_one.id = ClusterId(id);
  of_one.cell = CellId(0);
  ClusterPolygon polygon;
  polygon.surface = SurfaceId(0);
  polygon.polygon = surface.vertices;
  of_one.polygons = {polygon};
  return ClusterState(of_one, scene, Basis::linear);
}

/// What cluster `id` costs in an iteration: 0 reads something else in the third, 1 in the second
/// and third, which another rank gathers.
GatherCost cost_of(std::uint32_t id, int iteration) {
  GatherCost cost;
  cost.cluster = ClusterId(id);
  cost.figures.received_power = 10.0 * iteration + id;
  for_each_spectrum([&](const FigureName&, auto access) { access(cost.figures) = {0.0}; });
  for_each_histogram(
      [&](const FigureName&, auto access) { access(cost.figures).assign(RowSums::cells, 0.0); });
  cost.figures.absorbed_power = {0.25 * iteration};
  cost.figures.work.rays = iteration == 2 ? 0 : 100 + id;
  cost.patches = {3u * static_cast<unsigned>(iteration), 40, 50};
  cost.links_changed = iteration != 4;
  cost.links = {9, 90, 900};
  const bool other = iteration == 3 || (id == 1 && iteration == 2);
  cost.coupled.add(other ? 70 : 3);
  cost.coupled.add(200 + id);
  cost.read = {ClusterId(1 - id)};
  if (other) cost.read.push_back(ClusterId(0));
  return cost;
}

/// Which rank gathers for a cluster: 1's work is stolen by rank 1 in iterations 2 and 3.
int rank_of(std::uint32_t id, int iteration) {
  return id == 1 && (iteration == 2 || iteration == 3) ? 1 : 0;
}

TEST(CostRecorder, WhatIsReadBackIsWhatWasRecorded) {
  const std::string run = testing::TempDir() + "/recorded";
  std::filesystem::remove_all(run);
  std::filesystem::create_directories(run + "/common");
  RunMark mark;
  mark.prepared = true;
  write_run_mark(run, mark);
  std::vector<CostRecorder> ranks;
  for (int rank = 0; rank < 2; ++rank)
    ranks.emplace_back(run, run_name, Rank{rank}, IterationMethod{});
  for (const std::uint32_t id : {0u, 1u}) ranks[0].add_start(cluster(id));
  for (CostRecorder& rank : ranks) rank.write(0);
  for (int k = 1; k <= iterations; ++k) {
    for (const std::uint32_t id : {0u, 1u})
      ranks[static_cast<std::size_t>(rank_of(id, k))].add(cost_of(id, k));
    for (CostRecorder& rank : ranks) rank.write(k);
  }
  Manifest manifest;
  manifest.iteration = iterations;
  manifest.clusters = 2;
  manifest.preparation = mark.preparation();
  manifest.run = run_name;
  manifest.finished = true;
  manifest.history.assign(iterations, to_numbers(IterationSummary{}));
  commit_manifest(RunLayout(run), manifest);

  const Recording recording = read_recording(run, 2);
  ASSERT_EQ(recording.gathers.size(), static_cast<std::size_t>(iterations));
  for (int k = 1; k <= iterations; ++k) {
    for (const std::uint32_t id : {0u, 1u}) {
      const GatherCost& found = recording.gathers[static_cast<std::size_t>(k) - 1][id];
      const GatherCost wanted = cost_of(id, k);
      EXPECT_EQ(found.coupled.words(), wanted.coupled.words()) << k << " " << id;
      EXPECT_EQ(found.read, wanted.read) << k << " " << id;
      EXPECT_EQ(found.figures.received_power, wanted.figures.received_power);
      EXPECT_EQ(found.figures.absorbed_power, wanted.figures.absorbed_power);
      EXPECT_EQ(found.figures.work.rays, wanted.figures.work.rays);
      EXPECT_EQ(found.patches.count, wanted.patches.count);
      EXPECT_EQ(found.links.memory_bytes, wanted.links.memory_bytes);
    }
  }
  // What stays the same is kept once.
  const auto bytes = [&](int k) {
    return std::filesystem::file_size(run + "/costs/" + std::to_string(k) + "/rank-0");
  };
  EXPECT_LT(bytes(5), bytes(1));
}

}  // namespace
}  // namespace enfilade
