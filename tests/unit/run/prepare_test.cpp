#include "run/prepare.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/posix_file.hpp"
#include "scene_file/scene_io.hpp"
#include "unit/source_files.hpp"

namespace enfilade {
namespace {

TEST(Prepare, AnotherSceneOrOtherOptionsAreNotPrepared) {
  const std::string run = testing::TempDir() + "/enfilade-prepare-test";
  std::filesystem::remove_all(run);
  Warnings warnings;
  const Scene scene = read_scene(source_file("tests/data/scene/thin_gap.json"), warnings);
  PrepareConfig config;
  EXPECT_FALSE(is_prepared(run, scene.hash, config));
  prepare(scene, run, config, warnings);
  EXPECT_TRUE(is_prepared(run, scene.hash, config));
  EXPECT_FALSE(is_prepared(run, scene.hash + 1, config));
  const auto other = [&](auto change) {
    PrepareConfig changed = config;
    change(changed);
    return is_prepared(run, scene.hash, changed);
  };
  EXPECT_FALSE(other([](PrepareConfig& c) { c.cells.tolerance_relative *= 1.0 + 1e-15; }));
  EXPECT_FALSE(other([](PrepareConfig& c) { c.unreachable.seed = 2; }));
  EXPECT_FALSE(other([](PrepareConfig& c) { c.clusters.max_polygons = 8; }));
  std::filesystem::remove_all(run);
}

TEST(Prepare, TheSceneThatWasReadIsTheOneThatIsKept) {
  const std::string run = testing::TempDir() + "/enfilade-prepare-keeps", file = run + ".json";
  std::filesystem::remove_all(run);
  std::filesystem::copy_file(source_file("tests/data/scene/slivers.json"), file,
                             std::filesystem::copy_options::overwrite_existing);
  Warnings warnings, again;
  const Scene scene = read_scene(file, warnings);
  write_file_atomically(file, "overwritten meanwhile");
  const Prepared made = prepare(scene, run, {}, warnings);
  EXPECT_EQ(read_scene(run + "/scene.json", again).hash, scene.hash);

  // What was said of the scene is said of its run whenever that is loaded.
  const Prepared loaded = load_prepared(run);
  EXPECT_FALSE(loaded.warnings.empty());
  EXPECT_EQ(loaded.warnings.summary(100), warnings.summary(100));
  EXPECT_EQ(made.warnings.summary(100), warnings.summary(100));
  std::filesystem::remove_all(run);
  std::filesystem::remove(file);
}

TEST(Prepare, TheGraphComesBackAndADamagedOneIsRefused) {
  const std::string run = testing::TempDir() + "/enfilade-prepare-graph";
  std::filesystem::remove_all(run);
  Warnings warnings;
  const Scene scene = read_scene(source_file("tests/data/scene/thin_gap.json"), warnings);
  const Prepared made = prepare(scene, run, {}, warnings);
  ASSERT_GT(made.graph.edges(), 0u);
  const Prepared loaded = load_prepared(run);
  ASSERT_EQ(loaded.graph.size(), made.graph.size());
  for (std::size_t i = 0; i < made.graph.size(); ++i) {
    const auto was = made.graph.neighbours(i), is = loaded.graph.neighbours(i);
    EXPECT_TRUE(std::equal(was.begin(), was.end(), is.begin(), is.end())) << i;
  }
  const std::string file = run + "/graph.bin";
  const std::vector<std::byte> read = read_file(file);
  const std::string bytes(reinterpret_cast<const char*>(read.data()), read.size());
  ASSERT_GT(bytes.size(), 8u);
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    replace_file(file, damaged);
    EXPECT_THROW(load_prepared(run), RunError) << at;
  }
  for (const std::string& damaged :
       {std::string(), bytes.substr(0, bytes.size() - 1), bytes + "x", std::string("else")}) {
    replace_file(file, damaged);
    EXPECT_THROW(load_prepared(run), RunError) << damaged.size();
  }
  replace_file(file, bytes);
  EXPECT_NO_THROW(load_prepared(run));
  std::filesystem::remove_all(run);
}

}  // namespace
}  // namespace enfilade
