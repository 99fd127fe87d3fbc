#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;

std::string faketime_library() {
  for (const auto& folder : std::filesystem::directory_iterator("/usr/lib")) {
    const std::filesystem::path file = folder.path() / "faketime" / "libfaketimeMT.so.1";
    if (std::filesystem::exists(file)) return file;
  }
  return {};
}

/// The program on a host whose clock is wrong, beside a server that is results and historian in
/// one: nobody can tell which of the two is right.
class WrongClock : public testing::Test {
 protected:
  /// `offset` as faketime takes it, e.g. -5h.
  [[nodiscard]] ProgramResult run_at(const std::string& offset, const std::string& command,
                                     const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"/usr/bin/env", "LD_PRELOAD=" + faketime_library(),
                                   "FAKETIME=" + offset, "DONT_FAKE_MONOTONIC=1",
                                   "FAKETIME_DONT_FAKE_MONOTONIC=1"};
    for (const std::string& word : plant.command_line(command)) words.push_back(word);
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }
  Plant plant;
};

TEST_F(WrongClock, NothingIsDoneUntilAPersonHasSettledIt) {
  ASSERT_NE(faketime_library(), "") << "install the package faketime";
  plant.import_loop("FIC101", 600);
  const std::string before = plant.sql("SELECT * FROM loopscope.schedule");
  for (const char* const command : {"once", "maintain"}) {
    const ProgramResult refused = run_at("-5h", command);
    EXPECT_EQ(refused.exit_code, 4) << command;
    EXPECT_THAT(refused.err, HasSubstr("nobody confirms the results server's clock"));
    EXPECT_THAT(refused.err, HasSubstr("5 h 0 min behind"));
    EXPECT_THAT(refused.err, HasSubstr("HINT: set the clock that is wrong"));
  }
  EXPECT_EQ(plant.sql("SELECT * FROM loopscope.schedule"), before);

  const ProgramResult settled = run_at("-5h", "maintain", {"--accept-clock"});
  EXPECT_EQ(settled.exit_code, 0) << settled.err;
  EXPECT_THAT(settled.out, HasSubstr("accepted host "));
  const ProgramResult pass = run_at("-5h", "once");
  EXPECT_EQ(pass.exit_code, 0) << "the round after the pass knows it too: " << pass.err;
  EXPECT_EQ(plant.sql("SELECT count(*) FROM loopscope.analysis"), "1");
  EXPECT_EQ(run_at("+30d", "once").exit_code, 4) << "that is another difference";

  const ProgramResult right = plant.loopscope("maintain", {"--accept-clock"});
  EXPECT_THAT(right.out, HasSubstr("no clock differs"));
  EXPECT_EQ(plant.sql("SELECT count(*) FROM loopscope.accepted_clock"), "0");
}

}  // namespace
}  // namespace loopscope::tests
