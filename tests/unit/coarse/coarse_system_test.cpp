#include "coarse/coarse_system.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "coarse/sparse_solve.hpp"

#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

TEST(CoarseSystem, SolvesASmallSystemExactly) {
  // Two clusters of 3 m2 that see each other fully: E1 = rho2 E2 + 1, E2 = rho1 E1; three Jacobi
  // sweeps from zero have made E = (1, 0), (1, rho1), (1 + rho1 rho2, rho1). The correction must
  // lead to the fixed point at once.
  const double rho1 = 0.9, rho2 = 0.8, both = rho1 * rho2;
  CoarseSystem system(2, 1);
  const CoarseUnknowns unknowns{{0, 1}, {1, 1}, 2};
  CoarseRow first, second;
  first.absorbed = {0.2};
  first.escaping = {0.1};
  second.absorbed = {0.1};
  second.escaping = {0.05};
  first.before = {3.0};
  first.after = {3.0 * (1.0 + both)};
  second.before = second.after = {3.0 * rho1};
  first.entries = {{ClusterId(1u), true, {3.0 * both}}};
  second.entries = {{ClusterId(0u), true, {3.0 * rho1}}};
  system.add(ClusterId(0u), first, unknowns);
  system.add(ClusterId(1u), second, unknowns);
  const std::vector<double> x =
      CoarseSystem::from_numbers(system.to_numbers()).solve(unknowns).value();
  const double e1 = 1.0 / (1.0 - both), e2 = rho1 * e1;
  EXPECT_NEAR((1.0 + both) * (1.0 + x[0]), e1, 1e-5);
  EXPECT_NEAR(rho1 * (1.0 + x[1]), e2, 1e-5);
  EXPECT_NEAR(system.power(x), 3.0 * (e1 - 1.0 - both + e2 - rho1), 1e-4);
  EXPECT_NEAR(system.absorbed(x).front(), 0.2 * x[0] + 0.1 * x[1], 1e-12);
  EXPECT_NEAR(system.escaping(x).front(), 0.1 * x[0] + 0.05 * x[1], 1e-12);
}

TEST(CoarseSystem, TakesLightThatWasReadFreshAsItIs) {
  // As above, but the second cluster has read the first one's new light.
  const double rho1 = 0.9, rho2 = 0.8, both = rho1 * rho2;
  CoarseSystem system(2, 1);
  const CoarseUnknowns unknowns{{0, 1}, {1, 1}, 2};
  CoarseRow first, second;
  first.absorbed = first.escaping = second.absorbed = second.escaping = {0.0};
  first.before = {3.0};
  first.after = {3.0 * (1.0 + both)};
  second.before = {3.0 * rho1};
  second.after = {3.0 * rho1 * (1.0 + both)};
  first.entries = {{ClusterId(1u), true, {3.0 * both}}};
  second.entries = {{ClusterId(0u), false, {3.0 * rho1 * (1.0 + both)}}};
  system.add(ClusterId(0u), first, unknowns);
  system.add(ClusterId(1u), second, unknowns);
  const std::vector<double> x = system.solve(unknowns).value();
  const double e1 = 1.0 / (1.0 - both);
  EXPECT_NEAR((1.0 + both) * (1.0 + x[0]), e1, 1e-5);
  EXPECT_NEAR(rho1 * (1.0 + both) * (1.0 + x[1]), rho1 * e1, 1e-5);
}

/// An unknown gives no more than it reflects and keeps, whatever its links say: with flows that
/// claim more, the correction is that of flows at this limit.
TEST(CoarseSystem, WhatEscapesIsNotGiven) {
  const auto changes = [](double claimed) {
    CoarseSystem system(2, 1);
    const CoarseUnknowns unknowns{{0, 1}, {1, 1}, 2};
    CoarseRow row;
    row.before = {0.8};
    row.after = {1.0};
    row.absorbed = {0.2};
    row.escaping = {0.5};
    row.entries = {{ClusterId(1u), true, {0.1}}};
    system.add(ClusterId(0u), row, unknowns);
    row.entries = {{ClusterId(0u), true, {claimed}}};
    system.add(ClusterId(1u), row, unknowns);
    return system.solve(unknowns).value();
  };
  const double growth = 1.0 / 0.8, limit = 0.3 / growth;
  const std::vector<double> most = changes(0.6), at_limit = changes(limit), less = changes(0.1);
  EXPECT_GT(std::abs(at_limit[1]), 1.5 * std::abs(less[1]));
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(most[i], at_limit[i], 1e-9);
}

TEST(CoarseSystem, LightWithoutASourceVanishes) {
  // A closed pair of clusters with light left over, which fades by a tenth a sweep, and no source.
  CoarseSystem system(2, 1);
  const CoarseUnknowns unknowns{{0, 1}, {1, 1}, 2};
  CoarseRow row;
  row.before = {1.0};
  row.after = {0.9};
  row.absorbed = {0.09};
  row.escaping = {0.0};
  row.entries = {{ClusterId(1u), true, {0.9}}};
  system.add(ClusterId(0u), row, unknowns);
  row.entries = {{ClusterId(0u), true, {0.9}}};
  system.add(ClusterId(1u), row, unknowns);
  const std::vector<double> changes = system.solve(unknowns).value();
  for (const double change : changes) EXPECT_NEAR(change, -1.0, 1e-4);
}

/// Two clusters that only see each other, the first one's light `after` at last.
std::optional<std::vector<double>> solve_pair(double after, double before) {
  CoarseSystem system(2, 1);
  const CoarseUnknowns unknowns{{0, 1}, {1, 1}, 2};
  CoarseRow row;
  row.absorbed = row.escaping = {0.0};
  row.before = {before};
  row.after = {after};
  row.entries = {{ClusterId(1u), true, {1.0}}};
  system.add(ClusterId(0u), row, unknowns);
  row.before = row.after = {1.0};
  row.entries = {{ClusterId(0u), true, {0.5}}};
  system.add(ClusterId(1u), row, unknowns);
  return system.solve(unknowns);
}

/// Errors of links leave hardly lit unknowns with light below zero, in one band perhaps: such a one
/// gives nothing, and the others are corrected as without it.
TEST(CoarseSystem, LightBelowZeroIsNotGiven) {
  const auto solve = [](double after) {
    CoarseSystem system(3, 2);
    const CoarseUnknowns unknowns{{0, 1, 2}, {1, 1, 1}, 3};
    CoarseRow row;
    row.absorbed = row.escaping = {0.0, 0.0};
    row.before = {1.0, 1.0};
    row.after = {1.5, 1.5};
    row.entries = {{ClusterId(1u), true, {0.5, 0.5}}, {ClusterId(2u), true, {0.0, 0.1}}};
    system.add(ClusterId(0u), row, unknowns);
    row.entries = {{ClusterId(0u), true, {0.5, 0.5}}};
    system.add(ClusterId(1u), row, unknowns);
    row.entries.clear();
    row.before = {0.0, 1.0};
    row.after = {after, 1.0};
    system.add(ClusterId(2u), row, unknowns);
    return system.solve(unknowns);
  };
  const auto dark = solve(0.0), below = solve(-0.1);
  ASSERT_TRUE(dark && below);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ((*below)[i], (*dark)[i]);
  EXPECT_GT((*dark)[0], 0.0);
}

TEST(CoarseSystem, TellsWhereItHasNoSolution) {
  EXPECT_TRUE(solve_pair(1.0, 0.9));
  EXPECT_FALSE(solve_pair(1e300, 1e-300)) << "the growth is infinite";
  EXPECT_THROW(solve_pair(std::numeric_limits<double>::quiet_NaN(), 1.0), RunError);
  EXPECT_THROW(solve_pair(std::numeric_limits<double>::infinity(), 1.0), RunError);
}

TEST(SolveSparse, AddsEntriesOfOnePlace) {
  const std::vector<MatrixEntry> entries{{0, 0, 1.0}, {1, 1, 1.0}, {0, 1, -0.5}, {1, 1, 1.0}};
  const std::vector<double> right{1.0, 4.0};
  EXPECT_EQ(solve_sparse(entries, right).value(), (std::vector<double>{2.0, 2.0}));
}

TEST(SolveSparse, RefusesWhatHasNoSolution) {
  const std::vector<double> right{1.0, 2.0};
  const std::vector<MatrixEntry> singular{{0, 0, 1.0}, {0, 1, -1.0}, {1, 0, -1.0}, {1, 1, 1.0}},
      empty_row{{0, 0, 1.0}}, not_finite{{0, 0, NAN}, {1, 1, 1.0}};
  for (const auto& entries : {singular, empty_row, not_finite})
    EXPECT_FALSE(solve_sparse(entries, right));
  const std::vector<MatrixEntry> identity{{0, 0, 1.0}, {1, 1, 1.0}};
  EXPECT_FALSE(solve_sparse(identity, std::vector<double>{INFINITY, 1.0}));
}

TEST(CoarseCorrection, MakesIterationsIndependentOfReflectance) {
  for (const auto& [rho, aggregates] : std::vector<std::pair<double, bool>>{
           {0.5, true}, {0.9, true}, {0.99, true}, {0.999, true}, {0.9, false}, {0.999, false}}) {
    const testing::Solved with(testing::box_room({0, 0, 0}, {4, 4, 4}, {rho}, {1.0}), Basis::linear,
                               1e-3, true, 500, aggregates);
    EXPECT_LE(with.iterations, 12) << rho;
    EXPECT_NEAR(with.states[0].patches().irradiance(0)[0] * (1.0 - rho), 1.0, 1e-4) << rho;
  }
  const testing::Solved corridor(testing::box_room({0, 0, 0}, {40, 4, 4}, {0.99}, {1.0}),
                                 Basis::linear, 1e-3);
  EXPECT_LE(corridor.iterations, 40);  // 150 with one unknown a wall
  const testing::Solved without(testing::box_room({0, 0, 0}, {4, 4, 4}, {0.9}, {1.0}),
                                Basis::linear, 1e-3, false);
  EXPECT_GT(without.iterations, 30);
}

TEST(CoarseUnknowns, AreAggregatesWhereClustersAreFewAndSharedWhereTheyAreMany) {
  std::vector<Cluster> clusters(3);
  for (std::size_t i = 0; i < clusters.size(); ++i) clusters[i].id = ClusterId(i);
  clusters[0].area_m2 = 3.0;
  clusters[1].area_m2 = 1.0;
  const CoarseUnknowns few = coarse_unknowns(clusters, 11);
  EXPECT_EQ(few.aggregates, (std::vector<std::uint32_t>{7, 3, 1}));
  EXPECT_EQ(few.first, (std::vector<std::uint32_t>{0, 7, 10}));
  EXPECT_EQ(few.count, 11u);
  const std::vector<double> numbers(22, 1.0);
  EXPECT_EQ(few.of(ClusterId(1u), numbers, 2).data(), numbers.data() + 14);
  EXPECT_EQ(few.of(ClusterId(1u), numbers, 2).size(), 6u);
  CoarseUnknowns read = few;
  read.count = 0;
  EXPECT_TRUE(read.complete(3, 22));
  EXPECT_EQ(read.count, 11u);
  EXPECT_FALSE(read.complete(3, 23));
  EXPECT_FALSE(read.complete(2, 22));
  read.first[1] = 8;
  EXPECT_FALSE(read.complete(3, 24));
  clusters[1].cell = clusters[2].cell = CellId(1u);
  const CoarseUnknowns many = coarse_unknowns(clusters, 1, 2);
  EXPECT_EQ(many.first, (std::vector<std::uint32_t>{0, 1, 1}));
  EXPECT_EQ(many.count, 2u);
  read = many;
  EXPECT_TRUE(read.complete(3, 2));
}

}  // namespace
}  // namespace enfilade
