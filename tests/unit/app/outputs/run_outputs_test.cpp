#include "app/outputs/run_outputs.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/atomic_file.hpp"
#include "base/error.hpp"

namespace enfilade {
namespace {

TEST(RunOutputs, OnlyThoseOfASolveAreRemoved) {
  const std::string run = testing::TempDir() + "/enfilade-run-outputs";
  std::filesystem::create_directories(run + "/pictures");
  for (const char* name : {"/stats.json", "/pictures/a.png", "/scene.json"}) {
    write_file_atomically(run + name, "x");
  }
  remove_run_outputs(run);
  EXPECT_FALSE(std::filesystem::exists(run + "/stats.json"));
  EXPECT_FALSE(std::filesystem::exists(run + "/pictures"));
  EXPECT_TRUE(std::filesystem::exists(run + "/scene.json"));
  std::filesystem::remove_all(run);
}

TEST(RunOutputs, WhatCannotBeRemovedIsABrokenRunWithAName) {
  const std::string too_long(5000, 'a');
  try {
    remove_run_outputs(too_long);
    FAIL() << "nothing was wrong";
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()).find(too_long + "/stats.json: "), 0u);
  }
}

}  // namespace
}  // namespace enfilade
