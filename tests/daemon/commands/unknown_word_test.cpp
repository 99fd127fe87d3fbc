#include "daemon/commands/unknown_word.hpp"

#include <gtest/gtest.h>
#include <string>

namespace loopscope::daemon {
namespace {

/// What is said of a command line of a small program; "nothing" where no word is unknown.
std::string said_of(const std::string& line) {
  CLI::App program{"", "loopscope"};
  program.require_subcommand(1);
  std::string text;
  CLI::App& once = *program.add_subcommand("once");
  once.add_option("--config", text)->required();
  once.add_option("NUMBER", text);
  CLI::App& loops = *program.add_subcommand("loops");
  loops.add_option("--config", text)->required();
  CLI::App& list = *loops.add_subcommand("list");
  list.fallthrough();
  list.add_flag("--json");
  loops.add_subcommand("load")->fallthrough();
  try {
    program.parse(line);
  } catch (const CLI::ParseError&) {  // whatever the program would have said
  }
  const auto unknown = find_unknown_word(program);
  return unknown ? unknown->what + " HINT: " + unknown->hint : "nothing";
}

TEST(UnknownWord, CommandsAndTheirActions) {
  EXPECT_EQ(said_of("oncee"),
            "unknown command \"oncee\" HINT: did you mean \"once\"? loopscope --help lists them");
  EXPECT_EQ(said_of("oncee --config f"), said_of("oncee"));
  EXPECT_EQ(said_of("nonsense"), "unknown command \"nonsense\" HINT: loopscope --help lists them");
  EXPECT_EQ(said_of("loops lst --config f"),
            "loopscope loops has no action \"lst\" HINT: did you mean \"list\"? loopscope loops "
            "--help lists them");
  EXPECT_EQ(said_of("loops --config f laod"),
            "loopscope loops has no action \"laod\" HINT: did you mean \"load\"? loopscope loops "
            "--help lists them");
}

TEST(UnknownWord, ABeginningIsEnough) {
  EXPECT_EQ(said_of("loop"),
            "unknown command \"loop\" HINT: did you mean \"loops\"? loopscope --help lists them");
  EXPECT_EQ(said_of("on"),
            "unknown command \"on\" HINT: did you mean \"once\"? loopscope --help lists them");
  EXPECT_EQ(said_of("loops l"),
            "loopscope loops has no action \"l\" HINT: did you mean \"list\" or \"load\"? "
            "loopscope loops --help lists them");
}

TEST(UnknownWord, Options) {
  EXPECT_EQ(said_of("once --confg f"),
            "loopscope once has no option \"--confg\" HINT: did you mean \"--config\"? loopscope "
            "once --help lists them");
  EXPECT_EQ(said_of("once --confg=f"), said_of("once --confg f"));
  EXPECT_EQ(said_of("loops list --jsn --config f"),
            "loopscope loops list has no option \"--jsn\" HINT: did you mean \"--json\"? loopscope "
            "loops list --help lists them");
  EXPECT_EQ(said_of("once --config f -x"),
            "loopscope once has no option \"-x\" HINT: loopscope once --help lists them");
}

TEST(UnknownWord, NothingIsSaidOfWhatIsWrongOtherwise) {
  EXPECT_EQ(said_of("once --config f"), "nothing");
  EXPECT_EQ(said_of("once"), "nothing");
  EXPECT_EQ(said_of(""), "nothing");
  EXPECT_EQ(said_of("once --config f 1 2"), "nothing");
  EXPECT_EQ(said_of("once --config f -- -1 -2"), "nothing");
}

}  // namespace
}  // namespace loopscope::daemon
