#include "app/command_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace enfilade {
namespace {

CommandLine parse(std::vector<const char*> words) {
  words.insert(words.begin(), "enfilade");
  return parse_command_line(static_cast<int>(words.size()), words.data());
}

TEST(CommandLine, SolveRunsOnEveryRankAndTheOthersOnOne) {
  EXPECT_TRUE(parse({"solve", "scene.json", "-o", "run"}).command.on_every_rank);
  const CommandLine info = parse({"info", "scene.json"});
  EXPECT_FALSE(info.command.on_every_rank);
  EXPECT_TRUE(info.command.run);
  EXPECT_FALSE(info.fault);
}

TEST(CommandLine, HelpIsTextAndNoCommand) {
  const CommandLine help = parse({"render", "--help"});
  EXPECT_THAT(help.text, testing::HasSubstr("--look-at"));
  EXPECT_FALSE(help.command.run);
  EXPECT_FALSE(help.fault);
}

TEST(CommandLine, FaultsSayWhereAndWhatToDo) {
  const CommandLine wrong = parse({"solve", "scene.json", "-o", "run", "--target-error", "0"});
  ASSERT_TRUE(wrong.fault);
  EXPECT_THAT(wrong.fault->what(), testing::HasSubstr("--target-error"));
  EXPECT_THAT(wrong.fault->what(), testing::HasSubstr("; see 'enfilade solve --help'"));
  EXPECT_FALSE(parse({"sollve", "x"}).command.run);
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
