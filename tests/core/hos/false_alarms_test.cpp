// What the published rules do on signals that are linear and Gaussian: documentation that runs.
// The table of MEASURED.md is what this test prints.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <gtest/gtest.h>

#include "core/hos/analyse.hpp"
#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/signals.hpp"
#include "tests/support/chance.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::four_errors;

/// Per signal; LOOPSCOPE_RECORDS=20000 gives MEASURED.md's table.
int records() {
  return tests::records(500);
}

/// Mean and standard deviation of K times the mean bic2 (which eq. 9 has at 1 and 1 / sqrt(L) =
/// 0.031), and shares of records for which a rule fires.
struct AlarmRates {
  double mean = 0.0;
  double square = 0.0;
  [[nodiscard]] double deviation() const { return std::sqrt(square - mean * mean); }
  double ngi_above_zero = 0.0;
  double ngi_above_beta = 0.0;
  double nli_above_beta = 0.0;
  double any_peak = 0.0;
};

AlarmRates measure(const char* signal,
                   const std::function<std::vector<double>(std::uint64_t seed)>& draw) {
  AlarmRates rates;
  const Settings settings;
  const int count = records();
  const double share = 1.0 / count;
  for (int seed = 1; seed <= count; ++seed) {
    const auto result = analyse(draw(static_cast<std::uint64_t>(seed)), settings);
    const double scaled = static_cast<double>(result->segments) * result->mean_bic2;
    rates.mean += share * scaled;
    rates.square += share * scaled * scaled;
    rates.ngi_above_zero += result->ngi > 0.0 ? share : 0.0;
    rates.ngi_above_beta += result->published.gaussian ? 0.0 : share;
    rates.nli_above_beta += result->nli > settings.nli_threshold ? share : 0.0;
    rates.any_peak += result->peaks.empty() ? 0.0 : share;
  }
  std::printf("| %-20s | %5.3f | %5.3f | %5.1f %% | %5.1f %% | %5.1f %% | %5.1f %% |\n", signal,
              rates.mean, rates.deviation(), 100.0 * rates.ngi_above_zero,
              100.0 * rates.ngi_above_beta, 100.0 * rates.nli_above_beta, 100.0 * rates.any_peak);
  return rates;
}

// Expected are the rates over 20 000 records of white noise.
TEST(HosFalseAlarms, ThePublishedRulesFireFarMoreOftenThanTheyClaim) {
  std::printf("| linear, Gaussian     | K mean | std | NGI > 0 | > 0.001 | NLI>.01 | a peak  |\n");
  const AlarmRates white = measure("white", [](auto seed) { return tests::white_noise(seed); });
  EXPECT_NEAR(white.ngi_above_zero, 0.409, four_errors(0.409, records()));
  EXPECT_NEAR(white.ngi_above_beta, 0.072, four_errors(0.072, records()));
  EXPECT_GT(white.nli_above_beta, 0.98);
  EXPECT_NEAR(white.any_peak, 0.043, four_errors(0.043, records()));
}

TEST(HosFalseAlarms, ColourDoesNotCureThem) {
  for (const double pole : {0.9, 0.99, 1.0}) {
    char label[32];
    std::snprintf(label, sizeof label, "AR(1), pole %.2f", pole);
    const AlarmRates rates =
        measure(label, [pole](auto seed) { return tests::first_order_noise(seed, pole); });
    // Nominal 5 %: far outside whatever the colour.
    EXPECT_GT(rates.ngi_above_zero, 0.05 + four_errors(0.05, records())) << pole;
  }
  const AlarmRates sinusoid = measure(
      "sinusoid, period 300", [](auto seed) { return tests::sinusoid_in_noise(seed, 300.0); });
  EXPECT_GT(sinusoid.ngi_above_zero, 0.05 + four_errors(0.05, records()));
}

}  // namespace
}  // namespace loopscope::core::hos
