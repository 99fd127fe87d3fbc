#include "core/model/fit/best_wave.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>

#include "core/model/effects/external_oscillation.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kWaveSamples = 4000;
using tests::kNoise;

LoopData waving(const std::function<double(double)>& wave, std::uint64_t seed) {
  const tests::Series op = tests::stepping_op(kWaveSamples, seed);
  tests::Series load = tests::coloured_noise(kNoise, kWaveSamples, seed + 50, 0.5);
  for (std::size_t k = 0; k < kWaveSamples; ++k) load[k] += wave(static_cast<double>(k));
  return make_loop_data(tests::process_record(tests::one_lag(0.8, 3), 1.5, op, load), op, 1.0);
}

/// The best wave from a line of that period on.
ExternalOscillation best_from(double period, const LoopData& data) {
  const auto line = std::make_shared<ExternalOscillation>(period);
  Structure structure = tests::structure_of(tests::one_lag(0.8, 3), {line});
  structure.noise = kNoise;
  const PricedWave best = best_wave(FitVariants(data, structure), data, line);
  return dynamic_cast<const ExternalOscillation&>(*best.effect);
}

double angle(double k, double period) {
  return 2.0 * std::numbers::pi * k / period;
}

TEST(BestWave, ALineStaysALine) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const LoopData data = waving([](double k) { return std::sin(angle(k, 40.0)); }, seed);
    EXPECT_EQ(best_from(40.0, data).column_count(), 2U) << seed;
    EXPECT_EQ(best_from(40.0, data).period_samples(), 40.0) << seed;
  }
}

/// A harmonic stronger than its fundamental leads to it.
TEST(BestWave, FindsTheFundamentalOfAHarmonic) {
  const LoopData data =
      waving([](double k) { return std::sin(angle(k, 80.0)) + 1.5 * std::sin(angle(k, 40.0)); }, 1);
  const ExternalOscillation wave = best_from(40.0, data);
  EXPECT_EQ(wave.period_samples(), 80.0);
  EXPECT_EQ(wave.harmonics(), 2U);
}

TEST(BestWave, FollowsAPhaseThatWanders) {
  const LoopData data =
      waving([](double k) { return std::sin(angle(k, 40.0) + 3.0 * std::sin(k / 600.0)); }, 1);
  EXPECT_GT(best_from(40.0, data).column_count(), 2U);
  EXPECT_EQ(best_from(40.0, data).harmonics(), 1U);
}

TEST(BestWave, AFirstLookSeesALineWhosePhaseWanders) {
  const LoopData data =
      waving([](double k) { return std::sin(angle(k, 40.0) + 6.0 * std::sin(k / 600.0)); }, 1);
  const auto line = std::make_shared<ExternalOscillation>(40.0);
  Structure structure = tests::structure_of(tests::one_lag(0.8, 3), {line});
  structure.noise = kNoise;
  const FitVariants variants(data, structure);
  const auto rows = static_cast<double>(data.rows.fit_count());
  const double plain = rows * std::log(variants.fit_error(line));
  const PricedWave look = first_look_at_wave(variants, data, line);
  EXPECT_LT(look.misfit, plain - 30.0);
}

TEST(BestWave, AChangingWavePaysForItsColumns) {
  const LoopData data = waving([](double k) { return std::sin(angle(k, 40.0)); }, 1);
  const EffectPtr line = std::make_shared<ExternalOscillation>(40.0);
  const EffectPtr changing = slowly_changing(line, data);
  ASSERT_NE(changing, nullptr);
  EXPECT_EQ(changing->column_count(), 18U);
  Structure structure = tests::structure_of(tests::one_lag(0.8, 3), {line});
  structure.noise = kNoise;
  const Fit plain = evaluate(data, structure);
  const Fit more = evaluate(data, with_last(structure, changing));
  EXPECT_LT(more.fit_error, plain.fit_error);
  EXPECT_GT(misfit_of(more, data), misfit_of(plain, data));
}

TEST(BestWave, TooSlowAWaveDoesNotChange) {
  const LoopData data = waving([](double k) { return std::sin(angle(k, 900.0)); }, 1);
  EXPECT_EQ(slowly_changing(std::make_shared<ExternalOscillation>(900.0), data), nullptr);
}

}  // namespace
}  // namespace loopscope::core::model
