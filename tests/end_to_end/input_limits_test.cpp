#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "tests/support/run_program.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;

/// Files that are none, in place of every file that the program reads. The program may take 256 MB
/// of memory, which it inherits from here, and would stand out by an error of its own if it wanted
/// more. (Under a sanitizer there is no limit.)
class InputLimits : public testing::Test {
 protected:
  InputLimits() {
    getrlimit(RLIMIT_AS, &former_);
    const rlimit small{std::size_t{256} << 20U, former_.rlim_max};
    if (!kSanitized) setrlimit(RLIMIT_AS, &small);
  }
  ~InputLimits() override { setrlimit(RLIMIT_AS, &former_); }

  [[nodiscard]] std::string gigabyte(char fill) const {
    const std::string file = folder_.path() / (std::string("gigabyte_") + (fill ? fill : '0'));
    std::ofstream(file) << "t_s,pv\n";
    std::filesystem::resize_file(file, std::uintmax_t{1} << 30U);
    return file;
  }

  void expect_refused(const std::string& file, const std::string& words) const {
    SCOPED_TRACE(file);
    const ProgramResult settings = run_program({LOOPSCOPE_PROGRAM, "once", "--config", file});
    EXPECT_EQ(settings.exit_code, 3) << settings.err;
    EXPECT_THAT(settings.err, HasSubstr(words));
    const ProgramResult recording = run_program({LOOPSCOPE_PROGRAM, "analyze", file});
    EXPECT_EQ(recording.exit_code, 5) << recording.err;
    EXPECT_THAT(recording.err, HasSubstr(words));
    for (const std::string& text : {settings.err, recording.err}) {
      EXPECT_THAT(text, HasSubstr("error: "));
      EXPECT_THAT(text, HasSubstr("HINT: "));
    }
  }

  TemporaryFolder folder_;
  rlimit former_{};
};

TEST_F(InputLimits, DevicesFoldersAndHugeFilesAreRefusedAtOnce) {
  expect_refused("/dev/zero", "is not text");
  expect_refused(folder_.path(), "is a folder");
  expect_refused(folder_.path() / "absent", "No such file");
  expect_refused(gigabyte('\0'), "is larger than");
}

TEST_F(InputLimits, APipeThatNobodyWritesToIsRefusedWithinSeconds) {
  const std::string pipe = folder_.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const ProgramResult settings = run_program({LOOPSCOPE_PROGRAM, "once", "--config", pipe});
  EXPECT_EQ(settings.exit_code, 3);
  EXPECT_THAT(settings.err, HasSubstr("gives nothing"));
}

TEST_F(InputLimits, ALineOfCommasAloneIsNotKept) {
  const std::string file = folder_.path() / "commas.csv";
  std::ofstream(file) << std::string(std::size_t{70} << 20U, ',');
  const ProgramResult result = run_program({LOOPSCOPE_PROGRAM, "analyze", file});
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.err, testing::AnyOf(HasSubstr("cells"), HasSubstr("out of memory")));
}

}  // namespace
}  // namespace loopscope::tests
