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

}  // namespace
}  // namespace loopscope::daemon
