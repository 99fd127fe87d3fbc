#include "core/hos/transforms/settings.hpp"

#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <string>

namespace loopscope::core::hos {
namespace {

struct BadSetting {
  const char* setting;
  std::function<void(Settings&)> spoil;
};

TEST(HosSettings, DefaultsAndLimitsAreInRange) {
  EXPECT_NO_THROW(validate(Settings{}));
  Settings smallest{.segment_length = 16, .overlap = 0.0, .dft_length = 16, .alpha = 0.0001};
  smallest.max_peaks = 0;
  EXPECT_NO_THROW(validate(smallest));
  Settings largest{.segment_length = 4096, .overlap = 0.9, .dft_length = 8192, .alpha = 0.5};
  largest.max_peaks = 50;
  EXPECT_NO_THROW(validate(largest));
}

TEST(HosSettings, EverySettingOutOfRangeIsNamed) {
  const BadSetting cases[] = {
      {"segment_length", [](Settings& s) { s.segment_length = 14; }},
      {"segment_length", [](Settings& s) { s.segment_length = 65; }},
      {"segment_length", [](Settings& s) { s.segment_length = 4098; }},
      {"overlap", [](Settings& s) { s.overlap = -0.1; }},
      {"overlap", [](Settings& s) { s.overlap = 0.91; }},
      {"overlap", [](Settings& s) { s.overlap = std::numeric_limits<double>::quiet_NaN(); }},
      {"dft_length", [](Settings& s) { s.dft_length = 62; }},
      {"dft_length", [](Settings& s) { s.dft_length = 129; }},
      {"dft_length", [](Settings& s) { s.dft_length = 8194; }},
      {"alpha", [](Settings& s) { s.alpha = 0.0; }},
      {"alpha", [](Settings& s) { s.alpha = 0.6; }},
      {"ngi_threshold", [](Settings& s) { s.ngi_threshold = -0.001; }},
      {"nli_threshold", [](Settings& s) { s.nli_threshold = 1.5; }},
      {"max_peaks", [](Settings& s) { s.max_peaks = 51; }},
  };
  for (const BadSetting& spoiled : cases) {
    Settings settings;
    spoiled.spoil(settings);
    try {
      validate(settings);
      ADD_FAILURE() << spoiled.setting << " was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(spoiled.setting), std::string::npos) << error.what();
    }
  }
}

TEST(HosSettings, WindowShapesHaveNames) {
  EXPECT_EQ(name(WindowShape::hann), "hann");
  EXPECT_EQ(name(WindowShape::hann_periodic), "hann_periodic");
  EXPECT_EQ(name(WindowShape::hamming), "hamming");
  EXPECT_EQ(name(WindowShape::rectangular), "rectangular");
}

}  // namespace
}  // namespace loopscope::core::hos
