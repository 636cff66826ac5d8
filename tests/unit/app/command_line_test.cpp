#include "app/command_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/solve/command_solve.hpp"

namespace enfilade {
namespace {

CommandLine parse(std::vector<const char*> words) {
  words.insert(words.begin(), "enfilade");
  RankCommand solve;
  return parse_command_line(static_cast<int>(words.size()), words.data(),
                            [&](CLI::App& cli) { add_solve(cli, solve); });
}

TEST(CommandLine, SolveIsForAllRanksAndTheOthersForOneProcess) {
  RankCommand solve;
  const char* words[] = {"enfilade", "solve", "scene.json", "-o", "run"};
  const CommandLine line =
      parse_command_line(5, words, [&](CLI::App& cli) { add_solve(cli, solve); });
  EXPECT_TRUE(solve);
  EXPECT_FALSE(line.command);
  EXPECT_FALSE(line.fault);
  const CommandLine info = parse({"info", "scene.json"});
  EXPECT_TRUE(info.command);
  EXPECT_FALSE(info.fault);
}

TEST(CommandLine, HelpIsTextAndNoCommand) {
  const CommandLine help = parse({"render", "--help"});
  EXPECT_THAT(help.text, testing::HasSubstr("--look-at"));
  EXPECT_FALSE(help.command);
  EXPECT_FALSE(help.fault);
}

TEST(CommandLine, FaultsSayWhereAndWhatToDo) {
  const CommandLine wrong = parse({"solve", "scene.json", "-o", "run", "--target-error", "0"});
  ASSERT_TRUE(wrong.fault);
  EXPECT_THAT(wrong.fault->what(), testing::HasSubstr("--target-error"));
  EXPECT_THAT(wrong.fault->what(), testing::HasSubstr("; see 'enfilade solve --help'"));
  EXPECT_FALSE(parse({"sollve", "x"}).command);
  EXPECT_THAT(parse({"sollve", "x"}).fault->what(), testing::HasSubstr("did you mean 'solve'"));
}

TEST(CommandLine, NegativeCoordinatesAreNoOptions) {
  EXPECT_FALSE(parse({"render", "run", "-o", "a.png", "--eye", "-1", "-2.5", "1.6", "--look-at",
                      "0", "0", "-1"})
                   .fault);
  EXPECT_FALSE(
      parse({"render", "run", "-o", "a.png", "--eye", "1,-2,3", "--look-at", "0,0,0"}).fault);
}

}  // namespace
}  // namespace enfilade
