// §8's proof in numbers: the spectral radii that it speaks of, for assignments of a real G.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "assignment/assignment.hpp"
#include "geometry/form_factor.hpp"
#include "raycast/ray_scene.hpp"

namespace enfilade {
namespace {

constexpr double reflectance = 0.9;

/// Two rooms of 3 m, in square tiles of 1 m, with a door where one tile of either wall is left out.
std::vector<Cluster> two_tiled_rooms() {
  std::vector<Cluster> tiles;
  for (int room = 0; room < 2; ++room) {
    for (int face = 0; face < 6; ++face) {
      const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
      const bool high = face % 2 == 1;
      for (int tile = 0; tile < 9; ++tile) {
        const bool door = axis == 0 && high == (room == 0) && tile == 1;
        if (door) continue;
        Polygon corners;
        for (const auto& [du, dv] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          Vec3 p(0.0);
          p[axis] = high ? 3.0 : 0.0;
          p[u] = tile / 3 + du;
          p[v] = tile % 3 + dv;
          p.x += 3.0 * room;
          corners.push_back(p);
        }
        if (high) std::reverse(corners.begin(), corners.end());
        Cluster cluster;
        cluster.id = ClusterId(tiles.size());
        cluster.polygons.push_back({SurfaceId(tiles.size()), corners});
        cluster.area_m2 = 1.0;
        for (const Vec3& p : corners) cluster.bounds.add(p);
        tiles.push_back(std::move(cluster));
      }
    }
  }
  return tiles;
}

struct Tiles {
  std::vector<Cluster> clusters = two_tiled_rooms();
  std::size_t n = clusters.size();
  std::vector<double> matrix;  ///< N = reflectance times form factors, rows closed to 1
  ClusterGraph graph;

  Tiles() : matrix(n * n, 0.0) {
    std::vector<Polygon> polygons;
    for (const Cluster& c : clusters) polygons.push_back(c.polygons[0].polygon);
    const RayScene rays(polygons);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t i = 0; i < n; ++i) {
      const Vec3 x = centroid(polygons[i]), normal_i = normal(polygons[i]);
      for (std::uint32_t j = 0; j < n; ++j) {
        const double factor = point_to_polygon(x, normal_i, polygons[j]);
        if (factor < 1e-12 || rays.occluded(x, centroid(polygons[j]), i, j)) continue;
        matrix[i * n + j] = factor;
        pairs.emplace_back(i, j);
      }
      double* row = matrix.data() + i * n;
      const double sum = std::accumulate(row, row + n, 0.0);
      for (std::size_t j = 0; j < n; ++j) row[j] *= reflectance / sum;
    }
    graph = ClusterGraph(n, pairs);
  }
};

/// Of x -> D^-1 (U + L) x, where rank r's rows take their own rank's newest values: by powers of
/// the matrix, which is not negative.
double spectral_radius(const Tiles& tiles, std::span<const Rank> owner) {
  const std::size_t n = tiles.n;
  std::vector<double> x(n, 1.0);
  double radius = 0.0;
  for (int power = 0; power < 300; ++power) {
    std::vector<double> next(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const bool newest = j < i && owner[j] == owner[i];
        next[i] += tiles.matrix[i * n + j] * (newest ? next[j] : x[j]);
      }
    }
    radius = *std::max_element(next.begin(), next.end());
    for (std::size_t i = 0; i < n; ++i) x[i] = next[i] / radius;
  }
  return radius;
}

std::vector<Rank> each_its_own(std::size_t n) {
  std::vector<Rank> owner(n);
  for (std::size_t i = 0; i < n; ++i) owner[i] = Rank{static_cast<int>(i)};
  return owner;
}

TEST(GroupIteration, SpectralRadiiOfAssignmentsAreBelowThoseOfN) {
  const Tiles tiles;
  const double jacobi = spectral_radius(tiles, each_its_own(tiles.n));
  EXPECT_NEAR(jacobi, reflectance, 1e-9);  // rows sum to it
  const double gauss_seidel = spectral_radius(tiles, std::vector<Rank>(tiles.n, Rank{0}));
  // Stein and Rosenberg: both converge, and Gauss-Seidel is the faster one, near the square.
  EXPECT_LT(gauss_seidel, 0.95 * jacobi);
  for (const AssignmentMethod method : {AssignmentMethod::kmeans, AssignmentMethod::metis,
                                        AssignmentMethod::greedy, AssignmentMethod::round_robin}) {
    double fewer_ranks = gauss_seidel;
    for (const int ranks : {2, 4, 8, 16, 32}) {
      const std::vector<Rank> owner = assign(tiles.graph, FormFactorEstimate(tiles.clusters),
                                             {.method = method, .parts = ranks, .seed = 1});
      const double radius = spectral_radius(tiles, owner);
      EXPECT_LE(radius, jacobi + 1e-9) << name_of(method) << " on " << ranks;
      EXPECT_GE(radius, gauss_seidel - 1e-9) << name_of(method) << " on " << ranks;
      EXPECT_GE(radius, fewer_ranks - 0.02) << name_of(method) << " on " << ranks;
      fewer_ranks = radius;
    }
    EXPECT_GT(fewer_ranks, 0.95 * jacobi) << "32 ranks: close to Jacobi";
  }
}

}  // namespace
}  // namespace enfilade
