// Chi-square tests of points on polygons and of directions.
#include <gtest/gtest.h>

#include "geometry/sampling.hpp"
#include "unit/statistics.hpp"

namespace enfilade {
namespace {

using testing::UnitSquareCounts;
constexpr int draws = 200000, side = 16;
constexpr double two_pi = 2.0 * std::numbers::pi;

/// An azimuth in [0, 1) about n.
double turn_about(const Vec3& n, const Vec3& d) {
  const Vec3 other = std::abs(n.z) < 0.8 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
  const Vec3 u = glm::normalize(other - glm::dot(other, n) * n), v = glm::cross(n, u);
  const double turn = std::atan2(glm::dot(d, v), glm::dot(d, u)) / two_pi;
  return turn < 0.0 ? std::min(turn + 1.0, std::nextafter(1.0, 0.0)) : turn;
}

/// Under a cosine density the square of the sine is uniform, and so is the azimuth.
TEST(CosineDirection, IsDistributedByTheCosine) {
  Random random(1);
  const std::vector<Vec3> normals{
      {0, 0, 1}, {0, 0, -1}, {-1, 0, 0}, glm::normalize(Vec3(1, -2, 0.5))};
  for (const Vec3& n : normals) {
    UnitSquareCounts counts(side);
    for (int i = 0; i < draws; ++i) {
      const double r2 = random.uniform(), turn = random.uniform();
      const Vec3 d = cosine_direction(n, r2, turn);
      const double z = glm::dot(d, n);
      counts.add(std::min(1.0 - z * z, std::nextafter(1.0, 0.0)), turn_about(n, d));
    }
    EXPECT_TRUE(counts.are_uniform(static_cast<int>(normals.size())));
  }
}

TEST(SphereDirection, IsUniform) {
  Random random(2);
  UnitSquareCounts counts(side);
  for (int i = 0; i < draws; ++i) {
    const double z = 2.0 * random.uniform() - 1.0, turn = random.uniform();
    const Vec3 d = sphere_direction(z, turn);
    counts.add(0.5 * (d.z + 1.0), turn_about({0, 0, 1}, d));
  }
  EXPECT_TRUE(counts.are_uniform());
}

/// Where a point of a convex polygon lies: the sector about the middle of the corners that it lies
/// in, and the square of its share of the way to the edge, which is uniform.
struct SectorCounts {
  static constexpr std::size_t rings = 12;
  Vec3 middle{0.0};
  std::vector<double> counts, probability;

  explicit SectorCounts(const Polygon& polygon) : counts(polygon.size() * rings, 0.0) {
    for (const Vec3& corner : polygon) middle += corner / static_cast<double>(polygon.size());
    const double whole = area_m2(polygon);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const double sector = area_m2(Polygon{middle, polygon[i], polygon[(i + 1) % polygon.size()]});
      probability.insert(probability.end(), rings, sector / whole / rings);
    }
  }
  void add(const Polygon& polygon, const Vec3& p) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 a = polygon[i] - middle, b = polygon[(i + 1) % polygon.size()] - middle;
      const Vec3 n = glm::cross(a, b);
      const double n2 = glm::dot(n, n), u = glm::dot(glm::cross(p - middle, b), n) / n2,
                   v = glm::dot(glm::cross(a, p - middle), n) / n2;
      if (u < 0.0 || v < 0.0) continue;
      const double way = (u + v) * (u + v);
      ASSERT_LE(way, 1.0 + 1e-9);
      counts[i * rings + std::min(static_cast<std::size_t>(way * rings), rings - 1)] += 1.0;
      return;
    }
    FAIL() << "in no sector";
  }
};

/// A triangle, a long quadrilateral, a lopsided pentagon, a hexagon in space.
std::vector<Polygon> polygons() {
  return {{{0, 0, 0}, {3, 0, 0}, {0.5, 1, 0}},
          {{0, 0, 1}, {9, 0, 1}, {9.5, 0.4, 1}, {0.2, 0.3, 1}},
          {{0, 0, 0}, {2, 0.1, 0}, {2.2, 0.5, 0}, {1, 1.5, 0}, {0.1, 0.4, 0}},
          {{2, 0, 0}, {1, 1, 0.5}, {-1, 1, 0.5}, {-2, 0, 0}, {-1, -1, -0.5}, {1, -1, -0.5}}};
}

TEST(UniformPoint, IsUniformOverPolygons) {
  Random random(3);
  for (const Polygon& polygon : polygons()) {
    SectorCounts counts(polygon);
    for (int i = 0; i < draws / 2; ++i) {
      const double r1 = random.uniform(), r2 = random.uniform();
      counts.add(polygon, uniform_point(polygon, r1, r2));
    }
    EXPECT_TRUE(testing::are_distributed(counts.counts, counts.probability, 8));
  }
}

TEST(UniformPoint, IsUniformInThePlane) {
  Random random(4);
  for (const Polygon& polygon : polygons()) {
    std::vector<Vec2> flat;
    Polygon raised;
    for (const Vec3& p : polygon) {
      flat.emplace_back(p.x, p.y);
      raised.emplace_back(p.x, p.y, 0.0);
    }
    SectorCounts counts(raised);
    for (int i = 0; i < draws / 2; ++i) {
      const double r1 = random.uniform(), r2 = random.uniform();
      const Vec2 p = uniform_point(flat, area_m2(raised), r1, r2);
      counts.add(raised, {p.x, p.y, 0.0});
    }
    EXPECT_TRUE(testing::are_distributed(counts.counts, counts.probability, 8));
  }
}

/// Each triangle of the fan is as likely as any other, whatever its area; within one all points
/// are.
TEST(RandomPoint, IsUniformInEachTriangleOfTheFan) {
  Random random(5);
  const Polygon polygon = polygons()[2];
  std::vector<SectorCounts> counts;
  std::vector<Polygon> triangles;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
    counts.emplace_back(triangles.back());
  }
  std::vector<double> of_triangle(triangles.size(), 0.0);
  for (int i = 0; i < draws; ++i) {
    const Vec3 p = random_point(polygon, random);
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      const Polygon& t = triangles[k];
      // To the left of the fan's next ray.
      if (k + 1 < triangles.size() && glm::cross(t[2] - t[0], p - t[0]).z > 0.0) continue;
      counts[k].add(t, p);
      ++of_triangle[k];
      break;
    }
  }
  EXPECT_TRUE(testing::are_distributed(of_triangle, std::vector(3, 1.0 / 3.0), 4));
  for (const SectorCounts& c : counts)
    EXPECT_TRUE(testing::are_distributed(c.counts, c.probability, 4));
}

}  // namespace
}  // namespace enfilade
