#include "daemon/service/observe/work_report.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(CountText, SaysWhatBecameOfTheLoops) {
  EXPECT_EQ(count_text({}), "0 loops: 0 new, 0 revised, 0 unchanged, 0 failed");
  storage::WriteCount one;
  one.inserted = 1;
  EXPECT_EQ(count_text(one), "1 loop: 1 new, 0 revised, 0 unchanged, 0 failed");
  storage::WriteCount all;
  all.inserted = 20;
  all.revised = 1;
  all.unchanged = 3;
  all.failed = 2;
  all.fenced_off = 4;
  all.not_judged = 5;
  all.revised_earlier = 6;
  EXPECT_EQ(count_text(all),
            "30 loops: 20 new, 1 revised, 3 unchanged, 2 failed, 5 could not be judged "
            "(loopscope.data_problem), 6 earlier windows revised, 4 taken over by others");
  all.revised_earlier = 1;
  all.not_judged = all.fenced_off = 0;
  EXPECT_EQ(count_text(all),
            "26 loops: 20 new, 1 revised, 3 unchanged, 2 failed, 1 earlier window revised");
}

}  // namespace
}  // namespace loopscope::daemon
