#include "app/solve/solve_options.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include <filesystem>

#include "base/error.hpp"

namespace enfilade {
namespace {

TEST(SolveOptions, DefaultsAreTheSolversOwn) {
  SolveOptions options;
  options.input = "scene.json";
  options.output = "run";
  const SolveConfig config = options.config(), expected;
  EXPECT_EQ(config.run_directory, "run");
  EXPECT_EQ(config.target_error, expected.target_error);
  EXPECT_EQ(config.gather.basis, expected.gather.basis);
  EXPECT_EQ(config.assignment, expected.assignment);
  EXPECT_EQ(config.order, expected.order);
  EXPECT_EQ(config.steal, expected.steal);
  EXPECT_EQ(config.method.jacobi, expected.method.jacobi);
  EXPECT_EQ(config.scheme, expected.scheme);
  EXPECT_EQ(config.method.coarse_correction, expected.method.coarse_correction);
  EXPECT_EQ(config.memory_bytes, 0u);
}

TEST(SolveOptions, EachOneReachesTheSolver) {
  SolveOptions options;
  options.input = "scene.json";
  options.output = "run";
  options.memory = "1.5M";
  options.basis = "constant";
  options.assignment = "round-robin";
  options.oracle = "bf";
  options.visibility = "rays";
  options.order = "backtracking";
  options.scheme = "replicated";
  options.memory_manager = "malloc";
  options.iteration = "jacobi";
  options.no_steal = options.no_correction = options.resume = true;
  const SolveConfig config = options.config();
  EXPECT_EQ(config.memory_bytes, 3u << 19);
  EXPECT_EQ(config.gather.basis, Basis::constant);
  EXPECT_EQ(config.assignment, AssignmentMethod::round_robin);
  EXPECT_EQ(config.gather.oracle, OracleKind::brightness_form_factor);
  EXPECT_EQ(config.gather.visibility, VisibilityMethod::rays);
  EXPECT_EQ(config.order, TourOrder::backtracking);
  EXPECT_EQ(config.scheme, Scheme::replicated);
  EXPECT_EQ(config.memory_manager, MemoryManager::malloc);
  EXPECT_TRUE(config.method.jacobi);
  EXPECT_FALSE(config.steal);
  EXPECT_FALSE(config.method.coarse_correction);
  EXPECT_TRUE(config.resume);
}

SolveOptions parsed(std::vector<const char*> words) {
  SolveOptions options;
  CLI::App sub("solve");
  add_solve_options(sub, options);
  words.insert(words.begin(), {"solve", "scene.json", "-o", "run"});
  sub.parse(static_cast<int>(words.size()), words.data());
  return options;
}

TEST(SolveOptions, GaussSeidelIsHybridNow) {
  const SolveOptions before = parsed({"--iteration", "gauss-seidel"});
  EXPECT_EQ(before.iteration, "hybrid");
  ASSERT_EQ(before.notes.size(), 1u);
  EXPECT_EQ(before.notes[0], "--iteration gauss-seidel is called hybrid now");
  const SolveOptions now = parsed({"--iteration", "hybrid"});
  EXPECT_EQ(now.iteration, "hybrid");
  EXPECT_TRUE(now.notes.empty());
  EXPECT_THROW(parsed({"--iteration", "seidel"}), CLI::ParseError);
}

TEST(SolveOptions, AutoLeavesTheBasisToTheProgramWhichTakesLinear) {
  EXPECT_FALSE(parsed({}).basis_is_given());
  EXPECT_FALSE(parsed({"--basis", "auto"}).basis_is_given());
  EXPECT_TRUE(parsed({"--basis", "linear"}).basis_is_given());
  EXPECT_EQ(parsed({}).config().gather.basis, Basis::linear);
  EXPECT_EQ(parsed({"--basis", "auto"}).config().gather.basis, Basis::linear);
}

TEST(SolveOptions, ARunDirectoryIsSolvedInPlaceOrFromItsScene) {
  const std::string run = testing::TempDir() + "a_run";
  std::filesystem::create_directories(run);
  SolveOptions options;
  options.input = run;
  EXPECT_EQ(options.scene_file(), "");
  EXPECT_EQ(options.run_directory(), run);
  options.output = run + "/.";
  EXPECT_EQ(options.scene_file(), "");
  options.output = run + "_other";
  EXPECT_EQ(options.scene_file(), run + "/scene.json");
  EXPECT_EQ(options.run_directory(), run + "_other");
}

TEST(SolveOptions, BadMemoryIsRefusedByName) {
  SolveOptions options;
  options.input = "scene.json";
  options.output = "run";
  options.memory = "a lot";
  EXPECT_THROW(options.config(), InputError);
}

TEST(SolveOptions, AReplayTakesTheRunInPlaceOfAScene) {
  SolveOptions options;
  options.replay = "recorded";
  options.output = "run";
  EXPECT_EQ(options.config().run_directory, "run");
  options.output.clear();
  EXPECT_THROW(options.config(), InputError);
  options.output = "run";
  for (const char* of_the_light : {"--resume", "--scheme", "--target-error", "--basis"}) {
    options.given = {of_the_light};
    EXPECT_THROW(options.config(), InputError) << of_the_light;
  }
  options.given = {"--assignment", "--order", "--memory", "--no-steal"};
  EXPECT_NO_THROW(options.config());
  options.input = "scene.json";
  EXPECT_THROW(options.config(), InputError);
  options.input = options.replay = "";
  EXPECT_THROW(options.config(), InputError);
}

TEST(SolveOptions, ARivalSchemeRefusesWhatItWouldNotHeed) {
  SolveOptions options;
  options.input = "scene.json";
  options.output = "run";
  options.scheme = "master-slave";
  options.given = {"--scheme", "--order"};
  options.order = "random";
  EXPECT_NO_THROW(options.config());
  options.order = "unshot-energy";
  EXPECT_THROW(options.config(), InputError);
  options.scheme = "replicated";
  options.order = "random";
  EXPECT_THROW(options.config(), InputError);
  options.given = {"--scheme", "--assignment"};
  EXPECT_THROW(options.config(), InputError);
  options.scheme = "spmd";
  EXPECT_NO_THROW(options.config());
}

}  // namespace
}  // namespace enfilade
