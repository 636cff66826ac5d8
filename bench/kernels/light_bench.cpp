// What a gather is made of: form factors, kernels and visibility rays, each a kind of WorkCount
// that the cost model prices.
#include <benchmark/benchmark.h>

#include <vector>

#include "base/random.hpp"
#include "geometry/form_factor.hpp"
#include "raycast/ray_scene.hpp"

namespace enfilade::bench {
namespace {

constexpr std::size_t samples = 1024;

std::vector<Vec3> points_in(const Vec3& lo, const Vec3& hi) {
  Random random(7);
  std::vector<Vec3> points(samples);
  for (Vec3& p : points) {
    p = lo + (hi - lo) * Vec3(random.uniform(), random.uniform(), random.uniform());
  }
  return points;
}

void BM_PointToPolygonFormFactor(benchmark::State& state) {
  const std::vector<Vec3> points = points_in({0, 0, 0}, {4, 4, 0});
  const Polygon ceiling{{0, 0, 3}, {0, 4, 3}, {4, 4, 3}, {4, 0, 3}};
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(point_to_polygon(points[i++ % samples], {0, 0, 1}, ceiling));
  }
  state.counters["form_factors_per_second"] =
      benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_PointToPolygonFormFactor);

void BM_PointKernel(benchmark::State& state) {
  const std::vector<Vec3> points = points_in({0, 0, 0}, {4, 4, 0});
  std::size_t i = 0;
  for (auto _ : state) {
    const Vec3& x = points[i % samples];
    const Vec3 y = points[(i * 7 + 3) % samples] + Vec3(0, 0, 3);
    benchmark::DoNotOptimize(point_kernel(x, {0, 0, 1}, y, {0, 0, -1}));
    ++i;
  }
  state.counters["kernels_per_second"] =
      benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_PointKernel);

/// Boxes of half a metre, spread at random over a hall, `count` polygons in all.
std::vector<Polygon> furniture(std::int64_t count) {
  Random random(3);
  std::vector<Polygon> polygons;
  while (std::cmp_less(polygons.size(), count)) {
    const Vec3 at = Vec3(40.0 * random.uniform(), 40.0 * random.uniform(), 3.0 * random.uniform());
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 u(0.0), v(0.0), w(0.0);
      u[axis] = v[(axis + 1) % 3] = w[(axis + 2) % 3] = 0.5;
      polygons.push_back({at, at + v, at + u + v, at + u});
      polygons.push_back({at + w, at + w + u, at + w + u + v, at + w + v});
    }
  }
  return polygons;
}

void BM_RayScene(benchmark::State& state) {
  const std::vector<Polygon> polygons = furniture(state.range(0));
  const RayScene scene(polygons);
  const std::vector<Vec3> points = points_in({0, 0, 0}, {40, 40, 3});
  std::size_t i = 0, hidden = 0;
  for (auto _ : state) {
    hidden += scene.occluded(points[i % samples], points[(i * 7 + 3) % samples]);
    ++i;
  }
  state.counters["rays_per_second"] =
      benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["hidden_share"] = static_cast<double>(hidden) / static_cast<double>(i);
}
BENCHMARK(BM_RayScene)->Arg(600)->Arg(60000);

void BM_RaySceneBuild(benchmark::State& state) {
  const std::vector<Polygon> polygons = furniture(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(RayScene(polygons).bytes());
  state.counters["polygons_per_second"] = benchmark::Counter(
      static_cast<double>(polygons.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_RaySceneBuild)->Arg(60000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade::bench
