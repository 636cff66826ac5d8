#include "report/page/html_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "base/error.hpp"
#include "run/manifest.hpp"
#include "run/run_mark.hpp"
#include "run/sealed_reports.hpp"
#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

RunPage page(const std::string& name, int ranks) {
  RunPage p;
  p.name = name;
  p.stats.set("ranks", ranks);
  p.stats.set("surfaces", 57786);
  p.stats.set("estimated_error", 0.0175);
  p.stats.set("compute_s", std::vector<double>(static_cast<std::size_t>(ranks), 2.5));
  for (int i = 1; i <= 3; ++i) {
    RunRecord row;
    row.set("iteration", i);
    row.set("estimated_error", 1.0 / i);
    row.set("links", 100 * i);
    p.history.push_back(row);
  }
  return p;
}

/// Tags that open and close in order; those of HTML that stand alone are skipped.
bool well_formed(const std::string& html) {
  const std::regex tag("<(/?)([a-zA-Z0-9]+)([^>]*)>");
  std::vector<std::string> open;
  for (std::sregex_iterator it(html.begin(), html.end(), tag), end; it != end; ++it) {
    const std::string name = (*it)[2], rest = (*it)[3];
    if (name == "meta" || name == "img" || (!rest.empty() && rest.back() == '/')) continue;
    if ((*it)[1].length() == 0) {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return false;
    } else {
      open.pop_back();
    }
  }
  return open.empty();
}

TEST(HtmlReport, IsOnePageThatNeedsNothingElse) {
  RunPage run = page("duplex", 2);
  run.pictures.push_back({"room-1", "PNG"});
  const test::LitRooms rooms(1);
  run.plans = plans_of_run(rooms.solved().building(), {});
  const std::string html = report_html(std::span(&run, 1));
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("<link")));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, HasSubstr("data:image/png;base64,UE5H\""));
  EXPECT_TRUE(well_formed(html));
}

TEST(HtmlReport, Base64PadsItsEnd) {
  for (const auto& [bytes, text] : {std::pair<const char*, const char*>{"f", "Zg=="},
                                    {"fo", "Zm8="},
                                    {"foo", "Zm9v"},
                                    {"foob", "Zm9vYg=="},
                                    {"\xff\xfe\xfd", "//79"}}) {
    RunPage run = page("x", 1);
    run.pictures.push_back({"p", bytes});
    EXPECT_THAT(report_html(std::span(&run, 1)), HasSubstr(std::string("base64,") + text + "\""));
  }
}

TEST(HtmlReport, ShowsTheRun) {
  RunPage run = page("duplex", 2);
  run.warnings = {"surface 12 <turned round>"};
  run.attribution = {"licence: CC BY 4.0"};
  const test::LitRooms rooms(2);
  run.plans = plans_of_run(rooms.solved().building(), {});
  const std::string html = report_html(std::span(&run, 1));
  EXPECT_THAT(html, HasSubstr("57&#8239;786"));
  EXPECT_THAT(html, HasSubstr("1.8&#8239;%"));
  EXPECT_THAT(html, HasSubstr("surface 12 &lt;turned round&gt;"));
  EXPECT_THAT(html, HasSubstr("licence: CC BY 4.0"));
  EXPECT_THAT(html, HasSubstr("Convergence"));
  EXPECT_THAT(html, HasSubstr("Where the time went"));
  EXPECT_THAT(html, HasSubstr("rank 1"));
  EXPECT_THAT(html, HasSubstr("Storey 1: floor at 0.00 m"));
  EXPECT_THAT(html, Not(HasSubstr("side by side")));
}

TEST(HtmlReport, ComparesSeveralRuns) {
  std::vector<RunPage> runs{page("one", 1), page("four", 4)};
  runs[1].stats.set("steals", 17);
  const std::string html = report_html(runs);
  EXPECT_THAT(html, HasSubstr("2 runs"));
  EXPECT_THAT(html, HasSubstr("<th class=\"n\">four</th>"));
  EXPECT_THAT(html,
              HasSubstr("<tr><th>ranks</th><td class=\"n\">1</td><td class=\"n\">4</td></tr>"));
  EXPECT_THAT(
      html,
      HasSubstr("<tr><th>steals</th><td class=\"n\">&ndash;</td><td class=\"n\">17</td></tr>"));
  EXPECT_TRUE(well_formed(html));
}

TEST(HtmlReport, ReadsARunDirectory) {
  const std::string run = testing::TempDir() + "a_run";
  std::filesystem::create_directories(run + "/common");
  std::ofstream(run + "/stats.json") << R"({"ranks": 3})";
  std::ofstream(run + "/history.json") << R"([{"iteration": 1}])";
  RunMark mark;
  mark.prepared = true;
  keep_prepared_file(run, "scene.json", R"({"licence": "CC BY 4.0", "surfaces": []})", mark);
  write_run_mark(run, mark);
  Manifest manifest;
  manifest.preparation = mark.preparation();
  commit_manifest(RunLayout(run), manifest);
  seal_reports(run);
  for (const std::string& name : {run, run + "/"}) {
    const RunPage p = read_run_page(name);
    EXPECT_EQ(p.name, "a_run");
    EXPECT_EQ(p.stats.number("ranks", 0.0), 3.0);
    EXPECT_EQ(p.history.size(), 1u);
    EXPECT_EQ(p.attribution.size(), 1u);
  }
  std::ofstream(run + "/stats.json") << R"({"ranks": 4})";
  EXPECT_THROW(read_run_page(run), RunError) << "changed since";
  EXPECT_THROW(read_run_page(testing::TempDir() + "no_run"), InputError);
  std::filesystem::remove_all(run);
}

TEST(HtmlReport, TakesPicturesOfASolution) {
  test::LitRooms rooms(2);
  rooms.set_irradiance([](const Vec3&) { return 100.0; });
  RunPage run = page("rooms", 1);
  RenderConfig config;
  config.width = 64;
  config.height = 36;
  const auto cameras = automatic_cameras(rooms.solved());
  add_pictures(run, rooms.solved(), cameras, {}, config);
  // Two rooms and a cut-away; the first of each kind in false colour as well.
  ASSERT_EQ(run.pictures.size(), 5u);
  EXPECT_THAT(run.pictures[1].caption, HasSubstr("lx"));
  for (const Figure& f : run.pictures) EXPECT_EQ(f.png.substr(1, 3), "PNG");
  EXPECT_EQ(run.plans.size(), 1u) << "cells; an assignment needs several ranks";
  const std::vector<Rank> owner{Rank{0}, Rank{0}, Rank{1}, Rank{1}, Rank{0}};
  EXPECT_EQ(plans_of_run(rooms.solved().building(), owner).size(), 2u);
}

}  // namespace
}  // namespace enfilade
