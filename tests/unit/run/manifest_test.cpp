#include "run/manifest.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

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
  m.iteration = 7;
  m.clusters = 13;
  m.basis = Basis::linear;
  m.scene_hash = 0xFEDCBA9876543210u;
  m.history = {{1.0, 0.1}, {2.0, 1e-300}};
  commit_manifest(layout, m);
  const Manifest back = read_manifest(layout).value();
  EXPECT_EQ(back.iteration, 7);
  EXPECT_EQ(back.slot(), Slot::b);
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

}  // namespace
}  // namespace enfilade
