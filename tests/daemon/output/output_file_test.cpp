#include "daemon/output/output_file.hpp"

#include <gtest/gtest.h>

#include "daemon/failure.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::daemon {
namespace {

/// What write_file_test.cpp shows of whole contents holds for pieces too.
class OutputFileTest : public testing::Test {
 protected:
  tests::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "out.csv";

  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }
};

TEST_F(OutputFileTest, AppearsWhenItIsFinished) {
  OutputFile output(file_);
  output.write("a\n");
  output.write("b\n");
  EXPECT_FALSE(std::filesystem::exists(file_));
  output.finish();
  EXPECT_EQ(tests::content_of(file_), "a\nb\n");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(OutputFileTest, LeavesTheOldOneWhereItIsGivenUp) {
  std::ofstream(file_) << "old";
  { OutputFile(file_).write("new"); }
  EXPECT_EQ(tests::content_of(file_), "old");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(OutputFileTest, SaysWhichFileCannotBeWritten) {
  EXPECT_THROW(OutputFile(folder_.path() / "none" / "x"), Failure);
  OutputFile full("/dev/full");
  EXPECT_THROW(
      {
        full.write("x");
        full.finish();
      },
      Failure);
}

}  // namespace
}  // namespace loopscope::daemon
