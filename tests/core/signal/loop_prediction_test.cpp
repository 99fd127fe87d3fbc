#include "core/signal/loop_prediction.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "core/signal/spikes.hpp"

namespace loopscope::core::signal {
namespace {

constexpr std::size_t kLength = 4096;
constexpr std::size_t kDelay = 2;
constexpr double kLagSamples = 10.6;
constexpr double kGain = 9.45;  ///< 6 % below instability
constexpr double kIntegralSamples = 9.8;

struct Loop {
  Samples sp;
  Samples pv;
  Samples op;
};

/// A lag, a delay of 2 samples and a tight PI controller whose setpoint moves every 350 samples; an
/// outlier of `spike` (pv units) on every 200th reading of pv.
Loop tight_loop(std::uint64_t seed, double spike) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  const double pole = std::exp(-1.0 / kLagSamples);
  Loop loop;
  double x = 0.0;
  double load = 0.0;
  double integral = 0.0;
  for (std::size_t k = 0; k < kLength; ++k) {
    loop.sp.push_back(k % 350 == 0 ? uniform(random) : loop.sp.back());
    x = pole * x + (1.0 - pole) * (k >= kDelay ? loop.op[k - kDelay] : 0.0);
    load = 0.97 * load + 0.02 * normal(random);
    const double reading = k % 200 == 199 ? spike : 0.0;
    loop.pv.push_back(x + load + 0.03 * normal(random) + reading);
    const double error = loop.sp.back() - loop.pv.back();
    integral += kGain * error / kIntegralSamples;
    loop.op.push_back(kGain * error + integral);
  }
  return loop;
}

std::size_t count(const std::vector<bool>& marked) {
  return static_cast<std::size_t>(std::count(marked.begin(), marked.end(), true));
}

TEST(LoopPrediction, TheAnswerToASetpointIsNoSpike) {
  std::size_t found = 0;
  std::size_t by_pv_alone = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Loop loop = tight_loop(seed, 0.0);
    found += count(find_spikes(loop.pv, loop.op, loop.sp));
    by_pv_alone += count(find_spikes(loop.pv, {}, {}));
  }
  EXPECT_EQ(found, 0U);
  EXPECT_GT(by_pv_alone, 100U) << "the loop makes peaks that look like outliers";
}

TEST(LoopPrediction, AnOutlierOfTheTransmitterIsOneInATightLoopToo) {
  std::size_t hit = 0;
  std::size_t all = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Loop loop = tight_loop(seed, seed % 2 == 0 ? 4.0 : -4.0);
    const std::vector<bool> found = find_spikes(loop.pv, loop.op, loop.sp);
    all += count(found);
    for (std::size_t k = 199; k < kLength; k += 200) hit += found[k] ? 1U : 0U;
  }
  EXPECT_EQ(hit, 20U * 20U);
  EXPECT_LE(all, hit + 8U) << "one in fifty";
}

TEST(LoopPrediction, LeavesWhatNoPastTells) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Samples op(kLength);
  Samples noise(kLength);
  Samples pv(kLength, 0.0);
  for (std::size_t k = 0; k < kLength; ++k) {
    op[k] = normal(random);
    noise[k] = normal(random);
    if (k >= 3) pv[k] = 0.7 * pv[k - 1] + 2.0 * op[k - 3] + noise[k];
  }
  const Samples no_setpoint;
  const LoopPrediction prediction(pv, op, no_setpoint, std::vector<bool>(kLength, false));
  double sum = 0.0;
  for (std::size_t k = 20; k < kLength; ++k) sum += std::pow(prediction.error(pv, k) - noise[k], 2);
  // 24 coefficients of 4000 rows cost 24 / 4000 of the noise.
  EXPECT_LT(sum / kLength, 0.02);
}

TEST(LoopPrediction, SaysNothingWhereRowsAreMissingOrFew) {
  const Samples none;
  Samples pv(kLength);
  for (std::size_t k = 0; k < kLength; ++k) pv[k] = std::sin(0.1 * static_cast<double>(k * k));
  pv[1000] = kMissing;
  const LoopPrediction prediction(pv, none, none, std::vector<bool>(kLength, false));
  EXPECT_TRUE(std::isnan(prediction.error(pv, 1008)));
  EXPECT_FALSE(std::isnan(prediction.error(pv, 1009)));
  EXPECT_TRUE(std::isnan(prediction.error(pv, 0)));
  const Samples few(pv.begin(), pv.begin() + 40);
  EXPECT_TRUE(std::isnan(
      LoopPrediction(few, none, none, std::vector<bool>(few.size(), false)).error(few, 30)));
}

/// op follows pv and sp without noise, so that some columns are sums of others.
TEST(LoopPrediction, AControllerWithoutNoiseDoesNotUpsetIt) {
  const Loop loop = tight_loop(3, 0.0);
  const LoopPrediction prediction(loop.pv, loop.op, loop.sp, std::vector<bool>(kLength, false));
  double squares = 0.0;
  for (std::size_t k = 20; k < kLength; ++k) squares += std::pow(prediction.error(loop.pv, k), 2);
  EXPECT_LT(std::sqrt(squares / kLength), 0.06) << "load 0.02 and noise 0.03";
}

}  // namespace
}  // namespace loopscope::core::signal
