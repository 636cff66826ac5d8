#include "app/solve/run_choices.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace enfilade {
namespace {

std::string chosen(const RunRecord& record, const char* key) {
  return std::get<std::string>(*record.find(key));
}

TEST(RunChoices, FollowTheScene) {
  RunRecord hall;
  hall.set("bands", 1);
  hall.set("solved_bands", 1);
  hall.set("cells", 1);
  hall.set("basis", "linear");
  hall.set("visibility", "exact");
  hall.set("memory_bytes", 0);
  RunRecord house = hall;
  house.set("bands", 3);
  house.set("solved_bands", 3);
  house.set("cells", 12);
  describe_choices(hall, false);
  describe_choices(house, false);
  EXPECT_THAT(chosen(hall, "chosen_bands"), testing::StartsWith("1: the scene is grey"));
  EXPECT_THAT(chosen(house, "chosen_bands"), testing::StartsWith("3: "));
  house.set("solved_bands", 1);
  describe_choices(house, false);
  EXPECT_THAT(chosen(house, "chosen_bands"), testing::StartsWith("1 of 3: "));
  EXPECT_THAT(chosen(hall, "chosen_cells"), testing::StartsWith("1: no wall"));
  EXPECT_THAT(chosen(house, "chosen_cells"), testing::StartsWith("12: walls"));
  EXPECT_THAT(chosen(hall, "chosen_memory"), testing::StartsWith("no limit"));
  EXPECT_THAT(chosen(hall, "chosen_basis"), testing::StartsWith("linear: it takes fewer"));
}

TEST(RunChoices, SayWhatWasAskedAndWhatABudgetMeant) {
  RunRecord record;
  record.set("basis", "constant");
  record.set("visibility", "rays");
  record.set("memory_bytes", 1000);
  record.set("peak_cluster_bytes", 900);
  describe_choices(record, true);
  EXPECT_EQ(chosen(record, "chosen_basis"), "constant: as asked");
  EXPECT_EQ(chosen(record, "chosen_visibility"), "rays: as asked");
  describe_choices(record, false);
  EXPECT_EQ(chosen(record, "chosen_basis"), "constant: of the run that was resumed");
  EXPECT_THAT(chosen(record, "chosen_memory"), testing::StartsWith("within the budget"));
  record.set("peak_cluster_bytes", 1000);
  describe_choices(record, true);
  EXPECT_THAT(chosen(record, "chosen_memory"), testing::StartsWith("the budget is full"));
}

}  // namespace
}  // namespace enfilade
