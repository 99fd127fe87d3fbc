// Whatever the record: no exception, no NaN, and every p-value above 0 and at most 1.

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/hos/analyse.hpp"
#include "core/simulate/limit_cycle.hpp"
#include "tests/core/hos/signals.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::kInfinity;
using loopscope::tests::kNaN;

bool is_p(double p) {
  return p > 0.0 && p <= 1.0;
}

void expect_sound(const std::vector<double>& signal, const std::string& what) {
  const auto found = analyse(signal, Settings{}, 1);
  if (!found) return;
  EXPECT_TRUE(is_p(found->ngi_p.value())) << what << ": ngi_p " << *found->ngi_p;
  EXPECT_TRUE(is_p(found->nli_p.value())) << what << ": nli_p " << *found->nli_p;
  EXPECT_TRUE(is_p(found->cubic_p.value_or(1.0))) << what << ": cubic_p " << *found->cubic_p;
  EXPECT_TRUE(is_p(found->nonlinear_p.value())) << what << ": nonlinear_p " << *found->nonlinear_p;
  for (const Peak& peak : found->peaks) {
    EXPECT_TRUE(is_p(peak.p.value_or(1.0))) << what << ": peak " << *peak.p;
  }
}

/// One cycle every `period` samples, without noise.
std::vector<double> exact_wave(double period, double (*shape)(double turn)) {
  std::vector<double> wave(tests::kRecord);
  for (std::size_t n = 0; n < wave.size(); ++n) {
    wave[n] = shape(std::fmod(static_cast<double>(n), period) / period);
  }
  return wave;
}

using tests::sawtooth;
using tests::sine;
using tests::square;
using tests::triangle;

double pulse(double turn) {
  return turn < 0.1 ? 1.0 : 0.0;
}

TEST(HosAnalyseRobustness, ExactWavesHaveTinyPValuesAboveZero) {
  for (auto* const shape : {&sine, &square, &triangle, &sawtooth, &pulse}) {
    for (const double period : {2.0, 4.0, 8.0, 16.0, 20.0, 64.0, 409.6, 5000.0}) {
      expect_sound(exact_wave(period, shape), "exact wave of period " + std::to_string(period));
    }
  }
}

TEST(HosAnalyseRobustness, NoLengthBreaksIt) {
  const auto noise = tests::exponential_noise(1, 600);
  const auto wave = exact_wave(16.0, sawtooth);
  for (std::size_t samples = 0; samples <= 600; ++samples) {
    const auto count = static_cast<std::ptrdiff_t>(samples);
    expect_sound({noise.begin(), noise.begin() + count}, "noise of " + std::to_string(samples));
    expect_sound({wave.begin(), wave.begin() + count}, "wave of " + std::to_string(samples));
  }
}

TEST(HosAnalyseRobustness, MissingAndInfiniteSamplesAreLeftOut) {
  auto record = tests::exponential_noise(2);
  for (std::size_t n = 500; n < 1500; ++n) record[n] = n % 2 == 0 ? kNaN : kInfinity;
  record[3000] = -kInfinity;
  expect_sound(record, "gaps and infinities");
  EXPECT_FALSE(analyse(std::vector<double>(tests::kRecord, kNaN), Settings{}).has_value());
  EXPECT_FALSE(analyse(std::vector<double>(tests::kRecord, kInfinity), Settings{}).has_value());
  for (const std::size_t every : {65U, 96U, 130U, 300U}) {
    auto torn = tests::exponential_noise(3);
    for (std::size_t n = 0; n < torn.size(); n += every) torn[n] = kNaN;
    expect_sound(torn, "a gap every " + std::to_string(every));
  }
}

TEST(HosAnalyseRobustness, NearlyConstantRecords) {
  for (const double level : {0.0, 1.0, 0.1, 1e6}) {
    std::vector<double> constant(tests::kRecord, level);
    EXPECT_FALSE(analyse(constant, Settings{}).has_value()) << level;
    for (std::size_t n = 0; n < constant.size(); n += 7) {
      constant[n] = std::nextafter(level, kInfinity);
    }
    expect_sound(constant, "constant and rounding");
    constant = tests::affine(tests::white_noise(4), 1e-14, level);
    expect_sound(constant, "constant and very small noise");
    constant.assign(tests::kRecord, level);
    constant[2000] = level + 1.0;
    expect_sound(constant, "one step aside");
  }
}

TEST(HosAnalyseRobustness, OneSpike) {
  for (const double size : {1e6, 1e12, 1e300, -1e12}) {
    auto record = tests::white_noise(5);
    record[1234] = size;
    expect_sound(record, "spike");
  }
}

TEST(HosAnalyseRobustness, StepsAndRampsAndIntegers) {
  std::vector<double> ramp(tests::kRecord);
  std::vector<double> parabola(tests::kRecord);
  std::vector<double> step(tests::kRecord);
  auto integers = tests::affine(tests::white_noise(6), 2.0, 50.0);
  for (std::size_t n = 0; n < ramp.size(); ++n) {
    ramp[n] = 0.1 * static_cast<double>(n);
    parabola[n] = ramp[n] * ramp[n];
    step[n] = n < 2000 ? 0.0 : 1.0;
    integers[n] = std::round(integers[n]);
  }
  expect_sound(ramp, "ramp");
  expect_sound(parabola, "parabola");
  expect_sound(step, "step");
  expect_sound(integers, "integers");
  std::transform(integers.begin(), integers.end(), integers.begin(),
                 [](double value) { return value > 52.0 ? 1.0 : 0.0; });
  expect_sound(integers, "two levels");
}

TEST(HosAnalyseRobustness, TheUnitOfTheSignalChangesNoPValue) {
  const std::array records = {tests::exponential_noise(7), tests::white_noise(7),
                              simulate::limit_cycle({.period_samples = 30.0}, 4096, 7)};
  for (const auto& record : records) {
    const auto before = analyse(record, Settings{}, 1).value();
    for (const double gain : {0x1p1000, 0x1p-1000, 0x1p-1, 0x1p20}) {
      const auto found = analyse(tests::affine(record, gain, 0.0), Settings{}, 1).value();
      EXPECT_NEAR(found.nonlinear_p.value() / before.nonlinear_p.value(), 1.0, 1e-6) << gain;
      EXPECT_NEAR(found.cubic_p.value() / before.cubic_p.value(), 1.0, 1e-6) << gain;
    }
    expect_sound(tests::affine(record, 1e305, 0.0), "near the largest double");
    expect_sound(tests::affine(record, 1e-310, 0.0), "subnormal");
  }
}

}  // namespace
}  // namespace loopscope::core::hos
