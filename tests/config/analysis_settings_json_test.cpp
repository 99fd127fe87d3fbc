#include "config/analysis_settings_json.hpp"

#include <gtest/gtest.h>

#include "config/read_settings.hpp"
#include "tests/config/settings_text.hpp"

namespace loopscope::config::tests {
namespace {

core::AnalysisSettings round_trip(const core::AnalysisSettings& settings) {
  const std::string section = "\"analysis\": " + analysis_settings_json(settings);
  return parse_settings(minimal_with(section), "test.json").analysis;
}

TEST(AnalysisSettingsJson, NestsAsTheFileDoes) {
  const std::string json = analysis_settings_json({});
  EXPECT_EQ(json.substr(0, json.find("\"hos\"")),
            R"({"window_samples":4096,"min_usable_samples":512,"max_missing_fraction":0.4,)"
            R"("max_filled_gap":2,"slow_span_windows":4,"fit_model":true,)");
}

TEST(AnalysisSettingsJson, RoundTripKeepsEveryBit) {
  core::AnalysisSettings settings;
  settings.prepare.window_samples = 8192;
  settings.prepare.max_missing_fraction = 1.0 / 3.0;
  settings.prepare.slow_span_windows = 9;
  settings.fit_model = false;
  settings.hos.segment_length = 128;
  settings.hos.window = core::hos::WindowShape::rectangular;
  settings.hos.alpha = 0.1 + 0.2;
  settings.hos.ngi_threshold = 1e-17 / 3.0;
  settings.hos.max_peaks = 0;
  settings.oscillation.min_regularity = 2.0 / 7.0;
  settings.performance.max_delay_samples = 40;
  const core::AnalysisSettings back = round_trip(settings);
  EXPECT_EQ(back.prepare.window_samples, 8192U);
  EXPECT_EQ(back.prepare.max_missing_fraction, 1.0 / 3.0);
  EXPECT_EQ(back.prepare.slow_span_windows, 9U);
  EXPECT_FALSE(back.fit_model);
  EXPECT_EQ(back.hos.segment_length, 128U);
  EXPECT_EQ(back.hos.window, core::hos::WindowShape::rectangular);
  EXPECT_EQ(back.hos.alpha, 0.1 + 0.2);
  EXPECT_EQ(back.hos.ngi_threshold, 1e-17 / 3.0);
  EXPECT_EQ(back.hos.max_peaks, 0U);
  EXPECT_EQ(back.oscillation.min_regularity, 2.0 / 7.0);
  EXPECT_EQ(back.performance.max_delay_samples, 40U);
  EXPECT_EQ(analysis_settings_json(back), analysis_settings_json(settings));
}

TEST(AnalysisSettingsJson, AreReadBackInAnyOrderAndRefusedWhereTheyAreUnknown) {
  core::AnalysisSettings settings;
  settings.hos.alpha = 1.0 / 3.0;
  settings.fit_model = false;
  const std::string json = analysis_settings_json(settings);
  EXPECT_EQ(analysis_settings_json(parse_analysis_settings(json)), json);
  EXPECT_EQ(parse_analysis_settings(R"({"hos": {"alpha": 0.25}, "fit_model": false})").hos.alpha,
            0.25);
  EXPECT_THROW(static_cast<void>(parse_analysis_settings(R"({"later": 1})")), SettingsError);
}

}  // namespace
}  // namespace loopscope::config::tests
