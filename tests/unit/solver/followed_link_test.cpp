// src/FOLLOW_A_LINK.md follows a link of scenes/box.json from two polygons to a number of the
// report. Its figures are those that the solver gives: each that is worked out here must stand in
// the page.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "final_gather/point_gather.hpp"
#include "geometry/form_factor.hpp"
#include "scene_file/scene_io.hpp"
#include "solver/sequential_solver.hpp"
#include "unit/source_files.hpp"

namespace enfilade {
namespace {

class FollowedLink : public testing::Test {
 protected:
  void SetUp() override {
    std::ifstream page(source_file("src/FOLLOW_A_LINK.md"));
    page_.assign(std::istreambuf_iterator<char>(page), {});
    Warnings warnings;
    std::vector<Leak> leaks;
    prepared_ =
        prepare_scene(read_scene(source_file("scenes/box.json"), warnings), {}, warnings, leaks);
    occluders_ = std::make_unique<Occluders>(prepared_.clusters);
    solution_ = solve_sequentially(prepared_, *occluders_, {});
    find("floor", floor_, floor_polygon_);
    find("panel", panel_, panel_polygon_);
  }

  /// The cluster and the polygon that a surface became.
  void find(const std::string& name, std::size_t& cluster, std::uint32_t& polygon) const {
    for (cluster = 0; cluster < prepared_.clusters.size(); ++cluster) {
      const auto& polygons = prepared_.clusters[cluster].polygons;
      for (polygon = 0; polygon < polygons.size(); ++polygon) {
        if (prepared_.scene.surfaces[polygons[polygon].surface.index()].name == name) return;
      }
    }
    FAIL() << name;
  }

  /// The page has a row "| what | value |"; the value is this, to `share`.
  void expect_row(const std::string& what, double value, double share = 0.01) const {
    const std::size_t row = page_.find("| " + what + " | ");
    ASSERT_NE(row, std::string::npos) << what << " is " << value;
    EXPECT_NEAR(std::stod(page_.substr(row + what.size() + 5)), value, share * std::abs(value))
        << what;
  }

  std::string page_;
  Prepared prepared_;
  std::unique_ptr<Occluders> occluders_;
  Solution solution_;
  std::size_t floor_ = 0, panel_ = 0;
  std::uint32_t floor_polygon_ = 0, panel_polygon_ = 0;
};

TEST_F(FollowedLink, HasTheFiguresOfThePage) {
  const PatchForest& floor = solution_.clusters[floor_].patches();
  const PatchForest& panel = solution_.clusters[panel_].patches();
  const LinkSet& links = solution_.clusters[floor_].links();
  const std::size_t leaf = floor.leaf_at(floor_polygon_, {2.5, 2.0, 0.0});
  std::size_t from_panel = 0, followed = links.size();
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].shooter_cluster != ClusterId(panel_) || links[i].shooter.is_group() ||
        links[i].shooter.root != panel_polygon_ || links[i].receiver.root != floor_polygon_) {
      continue;
    }
    ++from_panel;
    if (floor.find(links[i].receiver) == leaf) followed = i;
  }
  ASSERT_LT(followed, links.size());
  const Link& link = links[followed];
  const std::size_t shooter = panel.find(link.shooter);
  const PolygonFrame& frame = floor.frames()[floor_polygon_];
  const Vec3 centroid = frame.at(floor.node(leaf).shape.centroid);
  const double factor = links.transport(followed)[0];

  expect_row("clusters", static_cast<double>(solution_.clusters.size()));
  expect_row("links in the end", static_cast<double>(solution_.history.back().figures.links), 0.05);
  expect_row("links from the panel to the floor", static_cast<double>(from_panel), 0.05);
  expect_row("path of the receiving patch", floor.node(leaf).id.path, 0.0);
  expect_row("area of the receiving patch, m2", floor.node(leaf).shape.area_m2);
  expect_row("transport coefficient", factor);
  expect_row("closed form at the patch's centroid",
             point_to_polygon(centroid, frame.n,
                              prepared_.clusters[panel_].polygons[panel_polygon_].polygon));
  expect_row("estimated error of the link, m2", link.error, 0.05);
  expect_row("radiosity of the panel, lm/m2", panel.radiosity(shooter)[0]);
  expect_row("irradiance that the link brings, lx", factor * panel.radiosity(shooter)[0]);
  expect_row("irradiance of the patch, lx", floor.irradiance(leaf)[0]);
  expect_row("radiosity of the patch, lm/m2", floor.radiosity(leaf)[0]);
  expect_row("iterations", static_cast<double>(solution_.history.size()), 0.0);
  const PointGather gather(solution_.clusters, prepared_.scene.lights, *occluders_, {});
  expect_row("illuminance at the probe, lx", gather.irradiance({2.5, 2.0, 0.75}, {0, 0, 1})[0]);
  EXPECT_LT(solution_.error.total(), 0.02);
}

}  // namespace
}  // namespace enfilade
