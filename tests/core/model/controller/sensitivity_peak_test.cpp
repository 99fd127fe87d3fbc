#include "core/model/controller/sensitivity_peak.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/core/model/known_loops.hpp"

namespace loopscope::core::model {
namespace {

TEST(SensitivityPeak, OfAnIntegratorWithGainOnlyIsAtTheNyquistFrequency) {
  const SensitivityPeak peak = find_sensitivity_peak({{1.0}, {1.0, -1.0}, 1}, known::law(0.5, 0.0));
  EXPECT_NEAR(peak.value, 2.0 / 1.5, 1e-9);
  EXPECT_NEAR(peak.frequency, std::numbers::pi, 1e-3);
}

TEST(SensitivityPeak, IsTheValueAtItsFrequencyAndNoNeighbourHasMore) {
  const SampledProcess process = known::paper_process();
  const ControllerLaw law = known::law(0.15, 0.3);
  const auto sensitivity = [&](double w) {
    return 1.0 / std::abs(1.0 + response(process, w) * response(law, w));
  };
  const SensitivityPeak peak = find_sensitivity_peak(process, law);
  EXPECT_NEAR(sensitivity(peak.frequency), peak.value, 1e-6 * peak.value);
  EXPECT_LT(sensitivity(0.98 * peak.frequency), peak.value);
  EXPECT_LT(sensitivity(1.02 * peak.frequency), peak.value);
}

TEST(SensitivityPeak, WithoutAPeakIsOne) {
  EXPECT_NEAR(find_sensitivity_peak({{0.0}, {1.0}, 1}, known::law(0.5, 0.1)).value, 1.0, 1e-9);
}

}  // namespace
}  // namespace loopscope::core::model
