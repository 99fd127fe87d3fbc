// The slow look within the diagnosis: when it is taken, on which samples, and how many it asks for.

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <stdexcept>

#include "core/diagnosis/diagnose.hpp"

namespace loopscope::core {
namespace {

/// The last `size` samples of one record: a second harmonic coupled to a fundamental, in noise.
signal::LoopWindow slow_loop(double period, std::size_t size) {
  constexpr std::size_t kRecord = 20'000;
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 0.2);
  signal::LoopWindow window;
  window.sample_interval_s = 2.0;
  for (std::size_t k = 0; k < kRecord; ++k) {
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(k) / period;
    window.pv.push_back(50.0 + std::cos(phase) + 0.3 * std::cos(2.0 * phase) + noise(random));
  }
  window.pv.erase(window.pv.begin(), window.pv.end() - static_cast<std::ptrdiff_t>(size));
  window.sp.assign(size, 50.0);
  return window;
}

TEST(FirstLook, AsksForALongerSpanWhereTheOscillationIsSlow) {
  EXPECT_EQ(first_look(slow_loop(30.0, 4096), {}).slow_span_samples, 0U);
  EXPECT_EQ(first_look(slow_loop(60.0, 4096), {}).slow_span_samples, 0U) << "the window is enough";
  EXPECT_EQ(first_look(slow_loop(204.0, 4096), {}).slow_span_samples, 17U * 528U);
  EXPECT_EQ(first_look(slow_loop(600.0, 4096), {}).slow_span_samples, 4U * 4096U);
}

TEST(FirstLook, AsksForNoMoreThanTheSettingsAllow) {
  AnalysisSettings settings;
  settings.prepare.slow_span_windows = 2;
  EXPECT_EQ(first_look(slow_loop(204.0, 4096), settings).slow_span_samples, 2U * 4096U);
  settings.prepare.slow_span_windows = 1;
  EXPECT_EQ(first_look(slow_loop(204.0, 4096), settings).slow_span_samples, 0U);
  const Diagnosis diagnosis = diagnose(slow_loop(204.0, 4096), settings);
  EXPECT_EQ(diagnosis.evidence.hos_slow.value().samples, 4096U);
}

TEST(FirstLook, AsksForNothingWhenTheWindowCannotBeJudged) {
  signal::LoopWindow window = slow_loop(204.0, 4096);
  window.mode.assign(window.size(), signal::ControlMode::manual);
  EXPECT_EQ(first_look(window, {}).slow_span_samples, 0U);
  EXPECT_EQ(diagnose(window, {}).verdict.code, diagnosis::VerdictCode::not_controlling);
}

TEST(DiagnoseSlowly, TheLongWindowServesTheSlowLookAlone) {
  const signal::LoopWindow window = slow_loop(204.0, 4096);
  const signal::LoopWindow longer = slow_loop(204.0, 17 * 528);
  const Evidence alone = diagnose(window, {}).evidence;
  const Evidence with = diagnose(window, {}, {}, &longer).evidence;
  EXPECT_EQ(alone.hos_slow.value().samples, 4096U);
  EXPECT_EQ(with.hos_slow.value().samples, 17U * 528U);
  EXPECT_EQ(with.hos_slow->result.segments, 60U);
  EXPECT_GT(with.hos_slow->result.ngi, 0.03);
  EXPECT_LT(with.hos->ngi, 0.003);
  EXPECT_EQ(with.hos->ngi, alone.hos->ngi);
  EXPECT_EQ(with.oscillation.period_s, alone.oscillation.period_s);
  EXPECT_EQ(with.slow_span_samples, alone.slow_span_samples);
  EXPECT_EQ(with.data_quality.flags, alone.data_quality.flags);
}

TEST(DiagnoseSlowly, AFirstLookGivesTheSameDiagnosis) {
  const signal::LoopWindow window = slow_loop(204.0, 4096);
  const Diagnosis whole = diagnose(window, {});
  const Diagnosis continued = diagnose(first_look(window, {}), {});
  EXPECT_EQ(whole.evidence.hos->ngi, continued.evidence.hos->ngi);
  EXPECT_EQ(whole.evidence.hos_slow->result.ngi, continued.evidence.hos_slow->result.ngi);
  EXPECT_EQ(whole.verdict.reasons, continued.verdict.reasons);
}

TEST(DiagnoseSlowly, FastLoopsHaveNoSlowLook) {
  EXPECT_FALSE(diagnose(slow_loop(30.0, 4096), {}).evidence.hos_slow);
}

TEST(DiagnoseSlowly, AnotherIntervalIsRefused) {
  signal::LoopWindow longer = slow_loop(204.0, 9000);
  longer.sample_interval_s = 1.0;
  EXPECT_THROW((void)diagnose(slow_loop(204.0, 4096), {}, {}, &longer), std::invalid_argument);
}

/// A calm loop behind a wide dead band holds one value for a window, as it did before.
TEST(FirstLook, WhatStandsStillInAllOfAWindowIsJudgedByALongerOne) {
  constexpr std::size_t kLong = 16384;
  signal::LoopWindow longer;
  for (std::size_t k = 0; k < kLong; ++k) {
    const auto t = static_cast<double>(k);
    longer.sp.push_back(50.0);
    longer.pv.push_back(k < 4000 || (k / 3000) % 2 == 0 ? 50.2 : 49.8);
    longer.op.push_back(40.0 + std::sin(t * t) + 5.0 * std::sin(1e-3 * t));
  }
  signal::LoopWindow window = longer;
  for (signal::Samples* series : {&window.sp, &window.pv, &window.op})
    series->erase(series->begin(), series->end() - 1024);
  AnalysisSettings settings;
  settings.prepare.window_samples = 1024;
  const FirstLook first = first_look(window, settings);
  ASSERT_TRUE(first.loop.still && first.loop.still->whole);
  EXPECT_EQ(first.slow_span_samples, 4096U);
  const Diagnosis alone = diagnose(first, settings);
  EXPECT_EQ(alone.verdict.code, diagnosis::VerdictCode::sensor_fault);
  const Diagnosis back = diagnose(first, settings, {}, &longer);
  EXPECT_FALSE(back.evidence.still);
  EXPECT_EQ(back.verdict.code, diagnosis::VerdictCode::insufficient_data);
  window.pv_past = signal::PvPast{10.0, 0.1};
  EXPECT_EQ(first_look(window, settings).slow_span_samples, 0U) << "its past is known";
}

}  // namespace
}  // namespace loopscope::core
