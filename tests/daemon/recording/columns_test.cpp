#include "daemon/recording/columns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/data_failure.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

Columns columns_of(const std::string& header) {
  return find_columns(parse_csv(header + "\n", "f.csv"));
}

std::string columns_failure(const std::string& header) {
  return data_failure([&] { return columns_of(header); }).what();
}

TEST(Columns, AnyOrderAndCase) {
  const Columns columns = columns_of("PV,Note,note, Time ,OP");
  EXPECT_EQ(columns.pv, 0U);
  EXPECT_EQ(columns.time, 3U);
  EXPECT_TRUE(columns.absolute_time);
  EXPECT_EQ(columns.op, 4U);
  EXPECT_FALSE(columns.sp || columns.mv || columns.mode || columns.quality);
}

TEST(Columns, SecondsGoBeforeIsoTimes) {
  const Columns columns = columns_of("time,t_s,pv");
  EXPECT_EQ(columns.time, 1U);
  EXPECT_FALSE(columns.absolute_time);
}

TEST(Columns, TimeAndProcessVariableAreNeeded) {
  EXPECT_EQ(columns_failure("a,b"), "f.csv, line 1: the header has neither \"t_s\" nor \"time\"");
  EXPECT_EQ(columns_failure("t_s,sp"), "f.csv, line 1: the header has no \"pv\" column");
}

TEST(Columns, AKnownColumnStandsOnce) {
  EXPECT_EQ(columns_failure("t_s,sp,pv,op,pv"), "f.csv, line 1: the column \"pv\" stands twice");
  for (const std::string name : {"t_s", "time", "sp", "op", "mv", "mode", "quality"}) {
    EXPECT_THAT(columns_failure("t_s,pv," + name + ", " + name + " "),
                HasSubstr("\"" + name + "\" stands twice"));
  }
}

}  // namespace
}  // namespace loopscope::daemon
