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
  EXPECT_EQ(
      columns_failure("a,b"),
      "f.csv, line 1: the header has neither \"t_s\" nor \"time\", but \"a\", \"b\" (separated "
      "by commas)");
  EXPECT_EQ(columns_failure("t_s,sp"),
            "f.csv, line 1: the header has no \"pv\" column, but \"t_s\", \"sp\" (separated by "
            "commas)");
  EXPECT_EQ(data_failure([] { return columns_of("a,b"); }).hint(),
            "say which columns they are: --columns time=NAME,pv=NAME,sp=NAME,op=NAME (t_s=NAME "
            "where the time is in seconds)");
}

TEST(Columns, AKnownColumnStandsOnce) {
  EXPECT_EQ(columns_failure("t_s,sp,pv,op,pv"), "f.csv, line 1: the column \"pv\" stands twice");
  for (const std::string name : {"t_s", "time", "sp", "op", "mv", "mode", "quality"}) {
    EXPECT_THAT(columns_failure("t_s,pv," + name + ", " + name + " "),
                HasSubstr("\"" + name + "\" stands twice"));
  }
}

TEST(Columns, ALongHeaderIsNotShownWhole) {
  std::string header = "a0";
  for (int k = 1; k < 30; ++k) header += ",a" + std::to_string(k);
  EXPECT_THAT(columns_failure(header), HasSubstr("\"a11\" and 18 more (separated by commas)"));
}

TEST(Columns, OtherSpellings) {
  const Columns columns =
      columns_of("Timestamp,FIC-101.Setpoint,FIC-101.PV [m3/h],FIC-101.Output,FIC-102.SP,Remark");
  EXPECT_EQ(columns.time, 0U);
  EXPECT_TRUE(columns.absolute_time && columns.by_other_names);
  EXPECT_EQ(columns.sp, 1U);
  EXPECT_EQ(columns.pv, 2U);
  EXPECT_EQ(columns.op, 3U);
  const Columns german = columns_of(
      "Zeit [s],Sollwert,Istwert,Stellgr\xC3\xB6\xC3\x9F"
      "e");
  EXPECT_FALSE(german.absolute_time);
  EXPECT_TRUE(german.sp == 1U && german.pv == 2U && german.op == 3U);
}

/// A file that could always be read is read as it always was.
TEST(Columns, OtherSpellingsCountOnlyWhereTheUsualNamesAreNotThere) {
  const Columns columns = columns_of("time,pv,Setpoint,FIC101.OP");
  EXPECT_FALSE(columns.sp || columns.op || columns.by_other_names);
  const CsvTable table = parse_csv("time,pv,Setpoint,x\n", "f.csv");
  EXPECT_THAT(column_notes(table, find_columns(table)),
              testing::ElementsAre("the column \"Setpoint\" is not read; --columns sp=Setpoint "
                                   "reads it"));
}

TEST(Columns, TwoThatMayBeTheSameAreAskedFor) {
  const Failure failure =
      data_failure([] { return columns_of("Timestamp,FIC101.PV,FIC102.PV,FIC102.SP"); });
  EXPECT_STREQ(failure.what(),
               "f.csv, line 1: \"FIC101.PV\" and \"FIC102.PV\" may both be the column pv");
  EXPECT_EQ(failure.hint(), "say which is meant: --columns pv=FIC101.PV");
}

Columns said_columns_of(const std::string& header, const std::string& columns) {
  return find_columns(parse_csv(header + "\n", "f.csv"), {.columns = parse_columns(columns)});
}

TEST(Columns, SaidByName) {
  const Columns columns =
      said_columns_of("Zeitstempel,W,pv_actual,Y,pv", "pv=PV_Actual, sp=W,op=Y,time=Zeitstempel");
  EXPECT_TRUE(columns.absolute_time);
  EXPECT_EQ(columns.pv, 2U);
  EXPECT_EQ(columns.sp, 1U);
  EXPECT_EQ(columns.op, 3U);
  EXPECT_FALSE(said_columns_of("t,pv", "t_s=t").absolute_time);
  EXPECT_TRUE(said_columns_of("t_s,t,pv", "time=t").absolute_time);
  EXPECT_EQ(said_columns_of("t_s,\"a,b\",c", "pv=a,b").pv, 1U);
  const Failure failure = data_failure([] { return said_columns_of("t_s,Actual,sp", "pv=Actal"); });
  EXPECT_STREQ(failure.what(),
               "f.csv, line 1: no column \"Actal\", which --columns names as pv: the header has "
               "\"t_s\", \"Actual\", \"sp\" (separated by commas)");
  EXPECT_EQ(failure.hint(), "did you mean \"Actual\"?");
}

}  // namespace
}  // namespace loopscope::daemon
