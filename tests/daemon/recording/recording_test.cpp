#include "daemon/recording/recording.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/data_failure.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

Recording recording_of(std::string_view text) {
  return parse_recording(parse_csv(text, "f.csv"));
}

std::string recording_failure(std::string_view text) {
  return data_failure([&] { return recording_of(text); }).what();
}

TEST(Recording, ColumnsInAnyOrderAndCase) {
  const Recording recording = recording_of("PV,Note,t_s, OP \n1,hello,0,50\n2,,10,51\n");
  EXPECT_FALSE(recording.absolute_time);
  EXPECT_EQ(recording.rows.pv.value, (std::vector<double>{1, 2}));
  EXPECT_EQ(recording.rows.op.value, (std::vector<double>{50, 51}));
  EXPECT_EQ(recording.rows.pv.time_us[1], 10'000'000);
  EXPECT_TRUE(recording.rows.sp.empty());
}

TEST(Recording, IsoTimes) {
  const Recording recording =
      recording_of("time,pv\n2026-03-01T00:00:00Z,1\n2026-03-01T01:00:10+01:00,2\n");
  EXPECT_TRUE(recording.absolute_time);
  EXPECT_EQ(recording.rows.pv.time_us[1] - recording.rows.pv.time_us[0], 10'000'000);
}

TEST(Recording, EmptyNotANumberAndInfinityAreMissing) {
  const Recording recording =
      recording_of("t_s,pv\n0,\n1,NaN\n2,nan\n3,inf\n4,-Infinity\n5,1e999\n6,+7.5\n");
  for (std::size_t k = 0; k < 6; ++k) EXPECT_TRUE(std::isnan(recording.rows.pv.value[k])) << k;
  EXPECT_EQ(recording.rows.pv.value[6], 7.5);
}

TEST(Recording, BadQualityIsMissing) {
  const Recording recording = recording_of(
      "t_s,sp,pv,op,quality\n0,1,2,3,192\n1,1,2,3,0\n2,1,2,3,GOOD\n3,1,2,3,bad\n4,1,2,3,\n");
  const auto& pv = recording.rows.pv.value;
  EXPECT_EQ(pv[0], 2.0);
  EXPECT_TRUE(std::isnan(pv[1]) && std::isnan(recording.rows.op.value[1]));
  EXPECT_EQ(pv[2], 2.0);
  EXPECT_TRUE(std::isnan(pv[3]));
  EXPECT_EQ(pv[4], 2.0);
}

TEST(Recording, ModeWords) {
  const Recording recording = recording_of("t_s,pv,mode\n0,1,AUTO\n1,1,Man\n2,1,2\n3,1,what\n");
  EXPECT_EQ(recording.rows.mode.value, (std::vector<double>{1, 0, 2, 3}));
}

TEST(Recording, TextInANumberColumnIsRefused) {
  EXPECT_THAT(recording_failure("t_s,pv\n0,1\n1,abc\n"),
              HasSubstr("line 3, column \"pv\": \"abc\" is not a number"));
  EXPECT_THAT(recording_failure("t_s,pv\n0,1.5.2\n"), HasSubstr("is not a number"));
  EXPECT_THAT(recording_failure("t_s,pv\n0,\"1,5\"\n"), HasSubstr("is not a number"));
}

TEST(Recording, ANulByteDoesNotCutTheMessage) {
  EXPECT_THAT(recording_failure(std::string_view("t_s,pv\n0,1\0x2\n", 14)),
              HasSubstr("\"1\\x00x2\" is not a number"));
}

TEST(Recording, ARepeatedTimeKeepsTheLastRowAndIsCounted) {
  const Recording recording = recording_of("t_s,pv\n0,1\n1,2\n1,3\n2,4\n");
  const auto window = last_window(recording, 4096, std::nullopt);
  EXPECT_EQ(window.pv, (std::vector<double>{1, 3, 4}));
  EXPECT_EQ(window.repeated_times, 1U);
}

TEST(Recording, LastWindowTakesTheLastSamples) {
  std::string text = "t_s,sp,pv\n";
  for (int k = 0; k < 100; ++k) text += std::to_string(60 * k) + ",5," + std::to_string(k) + "\n";
  const auto window = last_window(recording_of(text), 10, std::nullopt);
  EXPECT_EQ(window.size(), 10U);
  EXPECT_EQ(window.pv.front(), 90.0);
  EXPECT_EQ(window.sample_interval_s, 60.0);
  EXPECT_EQ(window.start_us, 90 * 60 * std::int64_t{1'000'000});
}

TEST(Recording, NoRowsGiveAnEmptyWindow) {
  EXPECT_EQ(last_window(recording_of("t_s,pv\n"), 4096, std::nullopt).size(), 0U);
  EXPECT_EQ(last_window(recording_of("t_s,pv\n7,1\n"), 4096, std::nullopt).size(), 1U);
}

TEST(Recording, AJumpOfCenturiesDoesNotExhaustMemory) {
  const auto window =
      last_window(recording_of("t_s,pv\n0,1\n1,2\n2e10,3\n20000000001,4\n"), 4096, std::nullopt);
  EXPECT_EQ(window.size(), 4096U);
}

Recording said_recording_of(std::string_view text, const RecordingForm& form = {}) {
  return parse_recording(text, "f.csv", form);
}

/// As a European spreadsheet saves it.
TEST(Recording, SemicolonsAndDecimalCommas) {
  const Recording recording = said_recording_of(
      "\xEF\xBB\xBFsep=;\r\nZeitstempel;FIC101.SP;FIC101.PV;FIC101.OP\r\n"
      "01.03.2026 12:00:00;50,0;\"1234,5\";-7,25\r\n01.03.2026 12:00:10;50;1,2E+03;\r\n");
  EXPECT_TRUE(recording.absolute_time);
  EXPECT_EQ(recording.rows.sp.value, (std::vector<double>{50, 50}));
  EXPECT_EQ(recording.rows.pv.value, (std::vector<double>{1234.5, 1200}));
  EXPECT_EQ(recording.rows.op.value[0], -7.25);
  EXPECT_TRUE(std::isnan(recording.rows.op.value[1]));
  EXPECT_EQ(recording.rows.pv.time_us[1] - recording.rows.pv.time_us[0], 10'000'000);
  EXPECT_THAT(recording.notes,
              testing::ElementsAre(
                  "time is \"Zeitstempel\", sp is \"FIC101.SP\", pv is \"FIC101.PV\", op is "
                  "\"FIC101.OP\"",
                  "cells are separated by semicolons, the decimal sign is the comma"));
}

TEST(Recording, TabsWithPoints) {
  const Recording recording = said_recording_of("t_s\tpv\tsp\n0\t1.5\t2\n");
  EXPECT_EQ(recording.rows.pv.value, std::vector<double>{1.5});
}

TEST(Recording, ACommaThatMayGroupThousandsIsRefused) {
  constexpr std::string_view kText = "t_s;sp;pv\n0;5;1,234\n1;5;12,345\n";
  const Failure failure = data_failure([&] { return said_recording_of(kText); });
  EXPECT_STREQ(
      failure.what(),
      "f.csv, line 2, column \"pv\": the comma in \"1,234\" may be a decimal sign or group "
      "thousands");
  EXPECT_EQ(failure.hint(),
            "--decimal-sign comma where it is the decimal sign; else write the numbers without "
            "groups");
  EXPECT_EQ(said_recording_of(kText, {.decimal_sign = ','}).rows.pv.value,
            (std::vector<double>{1.234, 12.345}));
  // One that cannot group thousands settles it.
  for (const char* cell : {"0,500", "1,5", ",5", "1234,500", "-,250"}) {
    const Recording recording = said_recording_of(std::string(kText) + "2;5;" + cell + "\n");
    EXPECT_EQ(recording.rows.pv.value[1], 12.345) << cell;
  }
}

TEST(Recording, PointsAndDecimalCommasDoNotMix) {
  const Failure failure =
      data_failure([] { return said_recording_of("t_s;pv\n0;1,5\n1;1.234,5\n"); });
  EXPECT_STREQ(failure.what(), "f.csv, line 3, column \"pv\": \"1.234,5\" is not a number");
  EXPECT_EQ(failure.hint(),
            "numbers of this file have decimal commas: all of them, and nothing between thousands");
  EXPECT_THAT(data_failure([] { return said_recording_of("t_s;pv\n0;1,5\n1;2.5\n"); }).what(),
              HasSubstr("line 3, column \"pv\": \"2.5\" is not a number"));
}

/// A comma within quotes is a decimal sign only where somebody says so.
TEST(Recording, CommasThatSeparateCellsAreNoDecimalSigns) {
  constexpr std::string_view kText = "t_s,pv\n0,\"1,5\"\n";
  const Failure failure = data_failure([&] { return said_recording_of(kText); });
  EXPECT_STREQ(failure.what(), "f.csv, line 2, column \"pv\": \"1,5\" is not a number");
  EXPECT_EQ(failure.hint(),
            "use a decimal point, or say --decimal-sign comma; leave a missing value empty");
  EXPECT_EQ(said_recording_of(kText, {.decimal_sign = ','}).rows.pv.value,
            std::vector<double>{1.5});
  EXPECT_TRUE(said_recording_of("t_s,pv\n0,1.5\n").notes.empty());
}

TEST(Recording, ColumnsSaidByName) {
  const Recording recording = said_recording_of(
      "Zeit;W;X;Y\n01/03/2026 12:00;1,5;2,5;3,5\n",
      {.columns = parse_columns("time=Zeit,sp=W,pv=X,op=Y"), .date_order = DateOrder::day_first});
  EXPECT_EQ(recording.rows.sp.value, std::vector<double>{1.5});
  EXPECT_EQ(recording.rows.pv.value, std::vector<double>{2.5});
  EXPECT_EQ(recording.rows.op.value, std::vector<double>{3.5});
}

TEST(RecordingForm, ColumnsThatAreNotRoleAndName) {
  const auto failure = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(parse_columns(text));
    } catch (const Failure& problem) {
      EXPECT_EQ(problem.exit_code(), ExitCode::usage);
      return std::string(problem.what()) + " HINT: " + problem.hint();
    }
    return "no failure";
  };
  constexpr const char* kExample = " HINT: e.g. --columns time=Zeitstempel,pv=PV_Actual,sp=W,op=Y";
  EXPECT_EQ(failure("PV_Actual"),
            std::string("--columns: \"PV_Actual\" is not ROLE=NAME of a column") + kExample);
  EXPECT_EQ(failure("pv="),
            std::string("--columns: \"pv=\" is not ROLE=NAME of a column") + kExample);
  EXPECT_EQ(failure("pv=A,pv=B"), std::string("--columns: \"pv\" stands twice") + kExample);
  EXPECT_EQ(failure("pw=A"),
            "--columns: no column of a recording is called \"pw\" HINT: did you mean \"pv\"?");
  EXPECT_THAT(failure("something=A"), HasSubstr("one of time, t_s, sp, pv, op, mv, mode, quality"));
}

}  // namespace
}  // namespace loopscope::daemon
