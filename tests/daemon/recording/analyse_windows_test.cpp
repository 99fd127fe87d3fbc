#include "daemon/recording/analyse_windows.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace loopscope::daemon {
namespace {

/// White noise about a setpoint of 50, every 10 s.
Recording noise(std::size_t samples) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(50.0, 1.0);
  Recording recording{"noise.csv", false, {}};
  for (std::size_t k = 0; k < samples; ++k) {
    const std::int64_t time_us = static_cast<std::int64_t>(k) * 10'000'000;
    for (core::signal::RawSeries* series : {&recording.rows.pv, &recording.rows.sp}) {
      series->time_us.push_back(time_us);
      series->value.push_back(series == &recording.rows.pv ? normal(random) : 50.0);
    }
  }
  return recording;
}

core::AnalysisSettings windows_of(std::size_t samples) {
  core::AnalysisSettings settings;
  settings.prepare.window_samples = samples;
  settings.fit_model = false;
  return settings;
}

TEST(AnalyseWindows, AsManyFullWindowsAsCoverTheRecording) {
  for (const auto& [samples, judged] :
       {std::pair{1024U, 1U}, {1025U, 2U}, {2048U, 2U}, {2100U, 3U}, {40'000U, 8U}}) {
    const WindowsAnalysis analysis = analyse_windows(noise(samples), windows_of(1024), {});
    EXPECT_EQ(analysis.judged, judged) << samples;
    EXPECT_EQ(analysis.newest_alone.has_value(), judged > 1) << samples;
    EXPECT_EQ(analysis.newest.window.size(), 1024U);
  }
}

TEST(AnalyseWindows, TheNewestAloneIsOneLook) {
  const Recording recording = noise(3000);
  const WindowsAnalysis several = analyse_windows(recording, windows_of(1024), {});
  const RecordingAnalysis one = analyse_recording(recording, windows_of(1024), {});
  EXPECT_EQ(several.newest_alone->code, one.diagnosis.verdict.code);
  EXPECT_EQ(several.newest_alone->confidence, one.diagnosis.verdict.confidence);
  EXPECT_GT(several.together, 0.0);
}

TEST(AnalyseWindows, AWindowThatCannotBeJudgedSaysNothing) {
  Recording recording = noise(2048);
  for (std::size_t k = 0; k < 1024; ++k) recording.rows.pv.value[k] = std::nan("");
  const WindowsAnalysis analysis = analyse_windows(recording, windows_of(1024), {});
  EXPECT_EQ(analysis.judged, 1U);
  EXPECT_FALSE(analysis.newest_alone);
}

}  // namespace
}  // namespace loopscope::daemon
