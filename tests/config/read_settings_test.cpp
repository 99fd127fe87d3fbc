#include "config/read_settings.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/config/settings_text.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::config::tests {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ReadSettings, MinimalFileHasTheDefaultsEverywhereElse) {
  const Settings settings = parse_settings(minimal_with(), "test.json");
  EXPECT_EQ(settings.results.connection, "service=results");
  ASSERT_EQ(settings.historians.size(), 1U);
  EXPECT_EQ(settings.historians[0].connection, "service=plant");
  EXPECT_EQ(settings.historians[0].name, HistorianSettings().name);
  EXPECT_EQ(settings.schedule.poll_s, ScheduleSettings().poll_s);
  EXPECT_EQ(settings.daemon.log_level, DaemonSettings().log_level);
  EXPECT_EQ(settings.flags.min_confidence, FlagSettings().min_confidence);
  EXPECT_EQ(analysis_settings_json(settings.analysis), analysis_settings_json({}));
}

TEST(ReadSettings, ValuesArriveWhereTheyBelong) {
  const Settings settings = parse_settings(
      R"({"results": {"connection": "a", "owner_connection": "b",
                      "engineer_connection": "c", "retention_months": 6},
          "historians": [{"name": "north", "connection": "c", "quality_rule": "zero"},
                         {"name": "south", "connection": "d", "quality_column": "",
                          "quality_rule": "none", "time_kind": "epoch_ms"}],
          "schedule": {"poll_s": 0.5, "batch_loops": 256},
          "daemon": {"workers": 3, "log_format": "json"},
          "analysis": {"max_filled_gap": 0,
                       "hos": {"segment_length": 128, "overlap": 0.75, "window": "hamming",
                               "dft_length": 256},
                       "oscillation": {"min_cycles": 7.5},
                       "performance": {"ar_order": 30}}})",
      "test.json");
  EXPECT_EQ(settings.results.owner_connection, "b");
  EXPECT_EQ(settings.results.engineer_connection, "c");
  EXPECT_EQ(settings.results.retention_months, 6);
  ASSERT_EQ(settings.historians.size(), 2U);
  EXPECT_EQ(settings.historians[0].quality_rule, "zero");
  EXPECT_EQ(settings.historians[1].name, "south");
  EXPECT_EQ(settings.historians[1].time_kind, "epoch_ms");
  EXPECT_EQ(settings.schedule.poll_s, 0.5);
  EXPECT_EQ(settings.schedule.batch_loops, 256);
  EXPECT_EQ(settings.daemon.workers, 3);
  EXPECT_EQ(settings.daemon.log_format, "json");
  EXPECT_EQ(settings.analysis.prepare.max_filled_gap, 0U);
  EXPECT_EQ(settings.analysis.hos.segment_length, 128U);
  EXPECT_EQ(settings.analysis.hos.overlap, 0.75);
  EXPECT_EQ(settings.analysis.hos.window, core::hos::WindowShape::hamming);
  EXPECT_EQ(settings.analysis.oscillation.min_cycles, 7.5);
  EXPECT_EQ(settings.analysis.performance.ar_order, 30U);
}

TEST(ReadSettings, CommentsAndByteOrderMarkAreSkipped) {
  const std::string text = "\xEF\xBB\xBF// the plant\n/* of\n two lines */" + minimal_with() + "//";
  EXPECT_THAT(lines_of(text), IsEmpty());
}

TEST(ReadSettings, EveryProblemIsReportedAtOnce) {
  const std::string text = R"({
    "results": {"connection": "host=db password=secret", "retention_months": "two"},
    "historians": [{"name": ""}, {"connection": "service=b", "tabel": "public.h"}],
    "schedule": {"poll_s": 0.01, "poll_s": 0.02, "lease_s": 5},
    "daemon": {"log_level": "verbose"},
    "analysis": {"hos": {"segment_length": 63, "dft_length": 32.5}},
    "extra": null})";
  EXPECT_THAT(
      lines_of(text),
      ElementsAre("/schedule/poll_s: is given more than once",
                  "/results/connection: holds a password",
                  "/results/retention_months: is a text, not a whole number, 0 to 1200 "
                  "months",
                  "/historians/0/name: is empty", "/historians/1/tabel: is not a known setting",
                  "/schedule/poll_s: 0.02 is out of range, 0.1 to 3600 s",
                  "/schedule/lease_s: 5 is out of range, 10 to 86400 s",
                  "/daemon/log_level: \"verbose\" is none of debug, info, warning, error",
                  "/analysis/hos/segment_length: 63 is odd, 16 to 4096 samples, even",
                  "/analysis/hos/dft_length: 32.5 is not a whole number, 16 to 8192 samples, "
                  "even",
                  "/extra: is not a known setting", "/historians/0/connection: is missing"));
}

TEST(ReadSettings, WhatNamesTheFileAndHasOneLinePerProblem) {
  try {
    static_cast<void>(parse_settings(
        minimal_with(R"("schedule": {"poll_s": 0.01, "batch_loops": 0})"), "plant.json"));
    FAIL() << "two values out of range were accepted";
  } catch (const SettingsError& error) {
    EXPECT_STREQ(error.what(),
                 "plant.json: /schedule/poll_s: 0.01 is out of range, 0.1 to 3600 s\n"
                 "plant.json: /schedule/batch_loops: 0 is out of range, 1 to 256 loops");
  }
}

TEST(ReadSettings, FileIsRead) {
  const loopscope::tests::TemporaryFolder folder;
  const auto file = folder.path() / "loopscope.json";
  std::ofstream(file) << minimal_with(R"("daemon": {"workers": 2})");
  EXPECT_EQ(read_settings(file).daemon.workers, 2);
}

TEST(ReadSettings, UnreadableFilesSayWhy) {
  const loopscope::tests::TemporaryFolder folder;
  const auto message = [](const std::filesystem::path& file) -> std::string {
    try {
      static_cast<void>(read_settings(file));
      return "accepted";
    } catch (const SettingsError& error) {
      return error.what();
    }
  };
  EXPECT_THAT(message(folder.path() / "absent.json"), HasSubstr("No such file"));
  EXPECT_THAT(message(folder.path()), HasSubstr("is a folder"));
  EXPECT_THAT(message("/dev/zero"), HasSubstr("is not text"));
}

}  // namespace
}  // namespace loopscope::config::tests
