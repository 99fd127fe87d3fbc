#include "core/model/fit/fit_variants.hpp"

#include <gtest/gtest.h>

#include "core/model/effects/curvature.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/effects/external_oscillation.hpp"
#include "core/model/effects/gain_change.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/effects/saturation.hpp"
#include "core/model/effects/valve.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kVariantSamples = 1500;

LoopData noisy_record(unsigned seed = 1) {
  const tests::Series op = tests::stepping_op(kVariantSamples, seed);
  return make_loop_data(
      tests::process_record(tests::one_lag(0.8, 3), 1.5, op,
                            tests::coloured_noise(tests::kNoise, kVariantSamples, seed + 1, 0.5)),
      op, 1.0);
}

/// One tap, two taps whose numerator the columns of effects go by, two lags, an integrator.
std::vector<Structure> structures(const std::vector<EffectPtr>& effects) {
  ProcessShape taps = tests::one_lag(0.8, 3);
  taps.numerator = {1.4, -0.4};
  std::vector<Structure> result;
  for (const ProcessShape& shape :
       {tests::one_lag(0.8, 3), taps, tests::two_lags(0.9, 0.6, 1), tests::integrator(2)}) {
    result.push_back(tests::structure_of(shape, effects));
    result.push_back(result.back());
    result.back().noise = {3, {0.98, 0.6, 0.2}, {-0.5, 0.1, -0.05}};
  }
  return result;
}

EffectPtr valve(double band, double jump) {
  return std::make_shared<ValveEffect>(Valve{ValveLaw::kano, band, jump, 1.0});
}

/// Those before the last: columns of time, columns that follow the flow, one that bends it.
std::vector<std::vector<EffectPtr>> companies() {
  return {{},
          {std::make_shared<LoadStep>(700), std::make_shared<ExternalOscillation>(41.0)},
          {std::make_shared<ValveCharacteristic>(), std::make_shared<LoadStep>(300),
           std::make_shared<GainChange>(600, 600)},
          {std::make_shared<Saturation>(-8.0, 8.0), std::make_shared<ProcessNonlinearity>()}};
}

/// All at once is each by itself.
void expect_alike(const FitVariants& variants, const std::vector<EffectPtr>& lasts) {
  const std::vector<double> full = variants.fit_errors(lasts, Digits::full);
  const std::vector<double> single = variants.fit_errors(lasts, Digits::single);
  for (std::size_t i = 0; i < lasts.size(); ++i) {
    const double error = variants.fit_error(lasts[i]);
    EXPECT_NEAR(full.at(i), error, 1e-9 * error);
    EXPECT_NEAR(single.at(i), error, 1e-4 * error);
  }
}

void expect_variants_the_slow_way(const LoopData& data, const std::vector<EffectPtr>& lasts) {
  for (std::vector<EffectPtr> effects : companies()) {
    effects.push_back(lasts.front());
    for (Structure structure : structures(effects)) {
      const FitVariants variants(data, structure);
      expect_alike(variants, lasts);
      for (const EffectPtr& last : lasts) {
        structure.effects.back() = last;
        const double error = evaluate(data, structure).fit_error;
        EXPECT_NEAR(variants.fit_error(last), error, 1e-9 * error) << name(last->kind());
      }
    }
  }
}

TEST(FitVariants, AreTheErrorsOfWholeFits) {
  const LoopData data = noisy_record();
  expect_variants_the_slow_way(data,
                               {std::make_shared<LoadStep>(500), std::make_shared<LoadStep>(504)});
  expect_variants_the_slow_way(
      data, {std::make_shared<ExternalOscillation>(50.0), std::make_shared<GainChange>(400, 900),
             std::make_shared<ProcessNonlinearity>()});
}

TEST(FitVariants, AreTheErrorsOfWholeFitsBehindAValve) {
  expect_variants_the_slow_way(
      noisy_record(), {valve(3.0, 1.0), valve(3.3, 0.0), std::make_shared<Saturation>(-5.0, 1e9)});
}

TEST(FitVariants, OfManyValvesAreThoseOfEach) {
  expect_variants_the_slow_way(noisy_record(), {valve(3.0, 1.0), valve(3.3, 0.0), valve(2.0, 2.0)});
}

/// Stems between the samples, each behind a process of its own.
TEST(FitVariants, OfManyStemsAndProcessesAreThoseOfEach) {
  const LoopData data = noisy_record();
  for (const std::vector<EffectPtr>& company : companies()) {
    std::vector<EffectPtr> effects = company;
    effects.push_back(valve(3.0, 1.0));
    const Structure structure = tests::structure_of(tests::two_lags(0.9, 0.6, 2), effects);
    const FitVariants variants(data, structure);
    std::vector<ValveEffect> valves;
    std::vector<ProcessShape> processes;
    for (int i = 0; i < 20; ++i) {
      const double band = 1.0 + 0.3 * i;
      valves.emplace_back(Valve{i % 2 == 0 ? ValveLaw::he : ValveLaw::kano, band, 0.05 * i * band,
                                1.0, BetweenSamples{0.1 + 0.03 * i, 0.1, 0.001}, 0.1 * i});
      processes.push_back(
          tests::two_lags(0.8 + 0.01 * i, 0.5, static_cast<std::size_t>(1 + i % 3)));
    }
    std::vector<ValveAndProcess> pairs;
    for (std::size_t i = 0; i < valves.size(); ++i) pairs.push_back({&valves[i], &processes[i]});
    const std::vector<double> full = variants.fit_errors(pairs, Digits::full);
    const std::vector<double> single = variants.fit_errors(pairs, Digits::single);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const double error = variants.fit_error(valves[i], processes[i]);
      EXPECT_NEAR(full.at(i), error, 1e-9 * error);
      EXPECT_NEAR(single.at(i), error, 1e-4 * error);
    }
  }
}

/// What is taken has the very error that it was ranked by, or in single precision the one that it
/// has by itself. Side by side and by itself differ by rounding: their filters run in other blocks.
TEST(FitVariants, TheBestIsTakenAndOfEqualOnesTheFirst) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const LoopData data = noisy_record(seed);
    const FitVariants variants(data, structures({valve(3.0, 1.0)}).front());
    const double linear = variants.fit_error(valve(1e-6, 0.0));
    BestVariant best{nullptr, linear};
    const std::vector<EffectPtr> worse{valve(6.0, 6.0), valve(5.0, 5.0)};
    EXPECT_FALSE(best.take(variants, worse, Digits::full));
    best.error = 1.1 * linear;
    const std::vector<EffectPtr> equal{valve(5.0, 5.0), valve(1e-6, 0.0), valve(1e-6, 0.0)};
    const double side_by_side = variants.fit_errors(equal, Digits::full).at(1);
    EXPECT_NEAR(side_by_side, linear, 1e-12 * linear);
    for (const Digits digits : {Digits::full, Digits::single}) {
      BestVariant found = best;
      EXPECT_TRUE(found.take(variants, equal, digits));
      EXPECT_EQ(found.effect, equal[1]);
      EXPECT_DOUBLE_EQ(found.error, digits == Digits::full ? side_by_side : linear);
    }
  }
}

TEST(FitVariants, SeeTheRowsOfTheFitAlone) {
  const LoopData data = on_other_fold(noisy_record());
  expect_variants_the_slow_way(data, {std::make_shared<LoadStep>(500)});
  expect_variants_the_slow_way(data, {valve(2.0, 2.0)});
}

/// pv seen at every sixth sample; two taps are for records with a row for each.
TEST(FitVariants, OfAHeldSensorAreTheErrorsOfWholeFits) {
  const LoopData whole = noisy_record();
  const LoopData data = make_loop_data(whole.pv, whole.op, 1.0, {6, 2});
  for (const EffectPtr& last : {valve(3.0, 1.0), EffectPtr(std::make_shared<LoadStep>(500, 6)),
                                EffectPtr(std::make_shared<GainChange>(400, 900))}) {
    const Structure structure = tests::structure_of(
        tests::two_lags(0.9, 0.6, 1), {std::make_shared<ExternalOscillation>(41.0),
                                       std::make_shared<ValveCharacteristic>(), last});
    const double error = evaluate(data, structure).fit_error;
    EXPECT_NEAR(FitVariants(data, structure).fit_error(last), error, 1e-9 * error);
  }
}

}  // namespace
}  // namespace loopscope::core::model
