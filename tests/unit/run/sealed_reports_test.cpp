#include "run/sealed_reports.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/posix_file.hpp"
#include "run/manifest.hpp"
#include "run/run_mark.hpp"

namespace enfilade {
namespace {

struct SealedReports : testing::Test {
  std::string run = testing::TempDir() + "/sealed_reports";
  Manifest manifest;

  SealedReports() {
    std::filesystem::remove_all(run);
    make_directory(run + "/common");
    RunMark mark;
    write_run_mark(run, mark);
    manifest.run = 7;
    manifest.preparation = mark.preparation();
    commit_manifest(RunLayout(run), manifest);
    replace_file(run + "/stats.json", "{}");
    seal_reports(run);
  }
  ~SealedReports() override { std::filesystem::remove_all(run); }
};

TEST_F(SealedReports, AreReadAsTheyWereWritten) {
  EXPECT_EQ(read_report(run, "stats.json"), "{}");
  EXPECT_EQ(read_report(run, "history.json"), std::nullopt);
}

TEST_F(SealedReports, AnEditIsFound) {
  replace_file(run + "/stats.json", "{ }");
  EXPECT_THROW(read_report(run, "stats.json"), RunError);
}

TEST_F(SealedReports, AFileThatIsGoneOrNewIsFound) {
  replace_file(run + "/history.json", "[]");
  EXPECT_THROW(read_report(run, "history.json"), RunError);
  remove_directory(run + "/stats.json");
  EXPECT_THROW(read_report(run, "stats.json"), RunError);
}

TEST_F(SealedReports, ThoseOfAnotherRunOrIterationAreFound) {
  manifest.run = 8;
  commit_manifest(RunLayout(run), manifest);
  EXPECT_THROW(read_report(run, "stats.json"), RunError);
  manifest.run = 7;
  manifest.iteration = 1;
  manifest.history = {{1.0}};
  commit_manifest(RunLayout(run), manifest);
  EXPECT_THROW(read_report(run, "stats.json"), RunError);
}

TEST_F(SealedReports, WithoutTheirSealTheyAreNotBelieved) {
  remove_directory(run + "/reports.json");
  EXPECT_THROW(read_report(run, "stats.json"), RunError);
}

TEST_F(SealedReports, AreWholeAsLongAsAllAreThereAndAsTheyWere) {
  replace_file(run + "/surfaces.csv", "a");
  const std::vector<std::string> more{"surfaces.csv"};
  EXPECT_TRUE(reports_are_whole(run, {}));
  EXPECT_FALSE(reports_are_whole(run, more));  // not sealed
  seal_reports(run, more);
  EXPECT_TRUE(reports_are_whole(run, more));
  EXPECT_EQ(read_report(run, "surfaces.csv"), "a");
  replace_file(run + "/surfaces.csv", "b");
  EXPECT_FALSE(reports_are_whole(run, more));
  EXPECT_FALSE(reports_are_whole(run, {}));
  remove_directory(run + "/surfaces.csv");
  EXPECT_FALSE(reports_are_whole(run, {}));
}

}  // namespace
}  // namespace enfilade
