#include "daemon/service/progress_bar.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(ProgressBar, FillsWithTheShareThatIsDone) {
  EXPECT_EQ(progress_text(0, 4, 8), "[........] 0/4 loops");
  EXPECT_EQ(progress_text(3, 4, 8), "[######..] 3/4 loops");
  EXPECT_EQ(progress_text(4, 4, 8), "[########] 4/4 loops");
  EXPECT_EQ(progress_text(1, 2, 2, "records"), "[#.] 1/2 records");
}

TEST(ProgressBar, NothingToDoAndMoreThanExpected) {
  EXPECT_EQ(progress_text(0, 0, 4), "[####] 0/0 loops");
  EXPECT_EQ(progress_text(5, 4, 4), "[####] 5/4 loops");
}

}  // namespace
}  // namespace loopscope::daemon
