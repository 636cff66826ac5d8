#include "run/manifest.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/posix_file.hpp"

namespace enfilade {
namespace {

RunLayout fresh_run(const char* name) {
  const std::string run = testing::TempDir() + "/" + name;
  remove_directory(run);
  make_directory(run + "/common");
  return RunLayout(run);
}

TEST(Manifest, ComesBackAsCommitted) {
  const RunLayout layout = fresh_run("manifest");
  EXPECT_FALSE(read_manifest(layout));
  Manifest m;
  m.iteration = 3;
  m.clusters = 13;
  m.basis = Basis::linear;
  m.scene_hash = 0xFEDCBA9876543210u;
  m.history = {{1.0, 0.1}, {2.0, 1e-300}, {3.0}};
  commit_manifest(layout, m);
  const Manifest back = read_manifest(layout).value();
  EXPECT_EQ(back.iteration, 3);
  EXPECT_EQ(back.clusters, 13u);
  EXPECT_EQ(back.basis, Basis::linear);
  EXPECT_EQ(back.scene_hash, m.scene_hash);
  EXPECT_EQ(back.history, m.history) << "to the last digit";
  EXPECT_FALSE(back.finished);
  remove_manifest(layout);
  EXPECT_FALSE(read_manifest(layout));
}

TEST(Manifest, AnInfiniteNumberStaysReadable) {
  const RunLayout layout = fresh_run("infinite_manifest");
  Manifest m;
  m.iteration = 1;
  m.history = {{std::numeric_limits<double>::infinity(), 1.0}};
  commit_manifest(layout, m);
  EXPECT_GT(read_manifest(layout).value().history[0][0], 1e300);
}

TEST(Manifest, DamageIsAnErrorAndNotANewRun) {
  const RunLayout layout = fresh_run("damaged_manifest");
  for (const char* text : {"", "{", "{\"format\": \"enfilade-manifest\", \"version\": 1}", "[]"}) {
    replace_file(layout.manifest(), text);
    EXPECT_THROW(read_manifest(layout), RunError) << text;
  }
}

TEST(Manifest, AnyEditIsFound) {
  const RunLayout layout = fresh_run("edited_manifest");
  Manifest m;
  m.iteration = 1;
  m.clusters = 2;
  m.history = {{1.0, 0.25}};
  m.correction = {0.5, 0.25};
  m.unknowns.first = {0, 1};
  m.unknowns.aggregates = {1, 1};
  m.unknowns.count = 2;
  commit_manifest(layout, m);
  const auto bytes = read_file(layout.manifest());
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const auto& [from, to] : {std::pair{"0.5", "1.5"},
                                 {"\"iteration\":1", "\"iteration\":0"},
                                 {"[[1.0,0.25]]", "[]"},
                                 {"\"constant\"", "\"linear\""},
                                 {"false", "true"}}) {
    std::string edited = text;
    const std::size_t at = edited.find(from);
    ASSERT_NE(at, std::string::npos) << from << " in " << text;
    edited.replace(at, std::string(from).size(), to);
    replace_file(layout.manifest(), edited);
    EXPECT_THROW(read_manifest(layout), RunError) << edited;
  }
  replace_file(layout.manifest(), text);
  EXPECT_EQ(read_manifest(layout).value().correction, m.correction);
}

}  // namespace
}  // namespace enfilade
