#include "daemon/report/programs/run_child.hpp"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "tests/support/process.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::daemon {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::Not;

ChildResult shell(const std::string& script, std::string_view input = "",
                  milliseconds patience = milliseconds(20'000), const std::stop_token& stop = {}) {
  return run_child({"/bin/sh", {"-c", script}, input, patience}, stop);
}

TEST(RunChild, CarriesInputAndOutputOfAnySize) {
  const std::string input(3'000'000, 'x');
  const ChildResult result = shell("cat", input);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, input);
}

TEST(RunChild, TellsCodeAndComplaint) {
  const ChildResult result = shell("echo wrong >&2; exit 7");
  EXPECT_EQ(result.exit_code, 7);
  EXPECT_EQ(result.complaint, "wrong\n");
  EXPECT_FALSE(result.out_of_time);
}

TEST(RunChild, AChildThatReadsNothingIsNoSignalForUs) {
  EXPECT_EQ(shell("exit 0", std::string(3'000'000, 'x')).exit_code, 0);
}

TEST(RunChild, EndsWhatTakesTooLongWithAllItHasStarted) {
  const ChildResult result = shell("sleep 60 & sleep 60", "", milliseconds(200));
  EXPECT_TRUE(result.out_of_time);
  EXPECT_EQ(result.exit_code, -1);
}

TEST(RunChild, EndsAtOnceWhenToldToStop) {
  std::stop_source source;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(milliseconds(100));
    source.request_stop();
  });
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(shell("sleep 60", "", milliseconds(60'000), source.get_token()).exit_code, -1);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST(RunChild, InheritsNoVariableAndNoDescriptor) {
  ::setenv("LOOPSCOPE_TEST_SECRET", "hidden", 1);
  const std::ofstream open_file("/dev/null");
  const ChildResult result = shell("env; ls /proc/self/fd | wc -l; pwd");
  EXPECT_THAT(result.out, Not(HasSubstr("LOOPSCOPE_TEST_SECRET")));
  EXPECT_THAT(result.out, HasSubstr("\n4\n"));  // three, and the folder that ls has opened
  EXPECT_THAT(result.out, HasSubstr("\n/\n"));
  ::unsetenv("LOOPSCOPE_TEST_SECRET");
}

TEST(RunChild, SaysWhatCannotBeStarted) {
  try {
    (void)run_child({"/nonexistent/program", {}, ""});
    FAIL() << "started";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
    EXPECT_THAT(error.what(), HasSubstr("cannot run /nonexistent/program"));
  }
}

TEST(RunChild, EndsWithUsHoweverWeAreEnded) {
  const tests::TemporaryFolder folder;
  const std::string file = folder.path() / "pid";
  const pid_t program = fork();
  ASSERT_GE(program, 0);
  if (program == 0) {
    (void)shell("echo $$ > " + file + ".new; mv " + file + ".new " + file + "; exec sleep 600", "",
                milliseconds(600'000));
    _exit(0);
  }
  const std::string child = tests::first_line_of(file, 20.0);
  EXPECT_NE(child, "");
  ::kill(program, SIGKILL);
  ::waitpid(program, nullptr, 0);
  EXPECT_TRUE(tests::ends_within(child, 20.0));
}

TEST(RunChild, FindsItsStreamsWhereWeHaveNone) {
  const pid_t program = fork();
  ASSERT_GE(program, 0);
  if (program == 0) {
    for (const int stream : {0, 1, 2}) ::close(stream);
    const ChildResult result = shell("cat; echo wrong >&2", "input");
    _exit(result.out == "input" && result.complaint == "wrong\n" ? 0 : 1);
  }
  int status = 0;
  ::waitpid(program, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(FindProgram, LooksThroughThePathAndOnlyThere) {
  EXPECT_EQ(find_program("sh", "/nonexistent:/bin"), "/bin/sh");
  EXPECT_EQ(find_program("sh", ""), std::nullopt);
  EXPECT_EQ(find_program("sh", ":."), std::nullopt);
  EXPECT_EQ(find_program("no-such-program", "/bin:/usr/bin"), std::nullopt);
}

// As a service that was started with root's PATH meets one. A link to itself cannot be looked into
// by root either.
TEST(FindProgram, AFolderThatCannotBeLookedIntoHasNone) {
  const tests::TemporaryFolder folder;
  const std::string closed = folder.path() / "closed";
  std::filesystem::create_symlink("closed", closed);
  EXPECT_EQ(find_program("sh", closed + ":/bin"), "/bin/sh");
  EXPECT_EQ(find_program("sh", closed), std::nullopt);
}

}  // namespace
}  // namespace loopscope::daemon
