#include "gather/row_closure.hpp"

#include <gtest/gtest.h>

#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

/// The floor of a closed, glowing room, 16 m2, has one link, to the ceiling.
struct Closed {
  std::vector<double> gathered;  ///< irradiance per band that the closure of its row adds
  RowClosureSums sums;
};
/// One of the links to the ceiling; its uncertainty is per m2, as its share is.
struct Part {
  float share, uncertainty;
  std::vector<double> light;
  double variation = 0.0;
};
Closed closed(const std::vector<Part>& parts) {
  const std::size_t bands = parts[0].light.size();
  const Scene scene =
      testing::box_room({0, 0, 0}, {4, 4, 4}, Spectrum(bands, 0.5), Spectrum(bands, 1.0));
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  const Occluders occluders(clusters);
  std::vector<ClusterState> states;
  for (const Cluster& c : clusters) states.emplace_back(c, scene, Basis::constant);
  RowClosure closure(states[0], nullptr, {});
  for (const ClusterState& s : states) closure.add_shooter(s);
  for (const Part& part : parts) {
    Link link;
    link.shooter_cluster = ClusterId(1u);
    link.shooter = link.receiver = {0, 1};
    link.error = part.uncertainty * 16.0f;
    link.variation = 16.0f;
    closure.add(link, std::span(&part.share, 1), part.light, {}, part.variation);
  }
  WorkCount work;
  Closed result{std::vector<double>(bands, 0.0), {}};
  result.sums = closure.close(occluders, {}, work, result.gathered);
  return result;
}
Closed closed(float share, float uncertainty, const std::vector<double>& light, double variation) {
  return closed({{share, uncertainty, light, variation}});
}

double added(float share, float uncertainty) {
  return closed(share, uncertainty, {800.0}, 0.0).gathered[0] / 800.0;
}

TEST(RowClosure, GivesARowWhatItLacks) {
  EXPECT_NEAR(added(0.75f, 0.5f), 0.25, 1e-6);
  EXPECT_NEAR(added(1.25f, 0.5f), -0.25, 1e-6);
}

/// The excess comes off the uncertain link first, then off both: from neither more than it brought.
TEST(RowClosure, TakesNoMoreFromALinkThanItBrought) {
  const auto taken = [](double certain, double uncertain) {
    return -closed({{0.9f, 0.0f, {certain}}, {0.4f, 0.3f, {uncertain}}}).gathered[0];
  };
  EXPECT_NEAR(taken(0.0, 800.0), 0.3 * 800.0, 1e-4);
  EXPECT_NEAR(taken(800.0, 0.0), 0.0, 1e-4);
  const auto taken_from_faint = [](double certain, double faint) {
    return -closed({{1.2f, 0.0f, {certain}}, {0.1f, 5.0f, {faint}}}).gathered[0];
  };
  EXPECT_NEAR(taken_from_faint(0.0, 800.0), 0.1 * 800.0, 1e-4);
  EXPECT_NEAR(taken_from_faint(800.0, 0.0), 0.2 * 800.0, 1e-4);
}

TEST(RowClosure, SumsTheDeficitsBeforeItself) {
  for (const float share : {0.75f, 1.25f}) {
    const RowClosureSums sums = closed(share, 0.5f, {800.0}, 0.0).sums;
    EXPECT_NEAR(sums.rows.deficit_m2, 0.25 * 16.0, 1e-9);
    EXPECT_NEAR(sums.rows.closed_m2, 16.0, 1e-9);
  }
}

/// A face that nearly touches another sees hardly anything else: the lamp whose light comes through
/// the gap does not fill the rest of its hemisphere.
TEST(RowClosure, AddsNoMoreOfTheLinksLightThanTheirUncertainty) {
  // 0.006 of the lamp's 800, and 0.974 of what the face sends out with that: 1 + 0.5 E.
  const double lamp = 0.006 * 800.0, own = (0.5 * lamp + 1.0) / (1.0 - 0.5 * 0.974);
  EXPECT_NEAR(added(0.02f, 0.006f), (lamp + 0.974 * own) / 800.0, 1e-4);
}

/// Links' errors make light negative in places; the variation of one band must not be weighted by
/// another band that has hardly any light.
TEST(RowClosure, UncertainLightOfOneBandIsBoundedByItsOwn) {
  EXPECT_NEAR(closed(1.0f, 0.0f, {-1000.0, 1e-3}, 500.0).sums.uncertain_power[0], -16.0 * 500.0,
              1e-6);
}

}  // namespace
}  // namespace enfilade
