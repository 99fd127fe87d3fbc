#include "core/model/selection/nominate.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/effects/external_oscillation.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::uint64_t kNominatedRecords = 10;

struct Looked {
  LoopData data;
  Fit fit;
};

/// The record of a scenario and the fit of its true process without the effect.
Looked looked_at(std::string_view scenario, std::uint64_t seed) {
  const simulate::LoopRecord record = simulate::simulate_scenario(scenario, {}, seed);
  Looked result{make_loop_data(record.pv, record.op, record.sample_interval_s), {}};
  Structure structure = tests::structure_of(tests::noiseless_process());
  structure.noise = {1, {0.98, 0.0, 0.0}, {-0.3, 0.0, 0.0}};
  result.fit = evaluate(result.data, structure);
  return result;
}

/// The place of a step is the largest of three: 0.2, 0.45 and 0.7 of the record.
TEST(Nominate, FindsThePlaceOfALoadStep) {
  for (std::uint64_t seed = 1; seed <= kNominatedRecords; ++seed) {
    const Looked looked = looked_at("load_upsets", seed);
    std::vector<long> places;
    for (const EffectPtr& effect : nominate_load_steps(looked.data, looked.fit)) {
      places.push_back(static_cast<long>(*effect->moment()));
    }
    ASSERT_FALSE(places.empty());
    for (const long truth : {819L, 1843L, 2867L}) {
      EXPECT_TRUE(std::ranges::any_of(places, [&](long at) { return std::abs(at - truth) <= 4; }))
          << truth << " seed " << seed;
    }
  }
}

/// The process still answers to what came before the record.
TEST(Nominate, PlacesNoLoadStepWhereThePastIsStillSeen) {
  for (const double pole : {0.5, 0.95, 0.999}) {
    for (std::uint64_t seed = 1; seed <= kNominatedRecords; ++seed) {
      Looked looked = looked_at("load_upsets", seed);
      looked.fit.structure.process.pole = pole;
      std::fill_n(looked.fit.innovations.begin() + 45, 3, 50.0);
      const double lags = std::min(3.0 / -std::log(pole), 512.0);
      for (const EffectPtr& effect : nominate_load_steps(looked.data, looked.fit)) {
        EXPECT_GE(static_cast<double>(*effect->moment()), lags);
      }
    }
  }
}

TEST(Nominate, FindsThePeriodOfALine) {
  for (std::uint64_t seed = 1; seed <= kNominatedRecords; ++seed) {
    const Looked looked = looked_at("outside_oscillation", seed);
    double nearest = 1e9;
    for (const EffectPtr& effect : nominate_oscillations(looked.data, looked.fit)) {
      const double period = dynamic_cast<const ExternalOscillation&>(*effect).period_samples();
      nearest = std::min(nearest, std::abs(period - 60.0));
    }
    EXPECT_LT(nearest, 0.3) << seed;
  }
}

TEST(Nominate, EveryKindComesFromItsOwnList) {
  const Looked looked = looked_at("healthy_flow", 1);
  const auto only = [](const std::vector<EffectPtr>& list,
                       std::initializer_list<EffectKind> kinds) {
    for (const EffectPtr& effect : list) {
      EXPECT_TRUE(std::ranges::find(kinds, effect->kind()) != kinds.end()) << name(effect->kind());
    }
  };
  using enum EffectKind;
  for (const EffectKind kind : {valve_saturation, valve_characteristic, process_nonlinearity,
                                gain_change, load_step, external_oscillation}) {
    const auto list = nominate(kind, looked.data, looked.fit);
    EXPECT_FALSE(list.empty()) << name(kind);
    only(list, {kind});
  }
}

/// A residual test says which; the spectrum is not looked at again.
TEST(Nominate, AWaveThatWasAskedForIsTriedAtItsPeriod) {
  const Looked looked = looked_at("outside_oscillation", 1);
  const std::vector<Nomination> asked = {
      {.effect = EffectKind::external_oscillation, .p = 1e-4, .period_samples = 83.5}};
  const auto waves = nominate(EffectKind::external_oscillation, looked.data, looked.fit, asked);
  ASSERT_EQ(waves.size(), 1U);
  EXPECT_EQ(dynamic_cast<const ExternalOscillation&>(*waves.front()).period_samples(), 83.5);
}

TEST(Nominate, GainChangesCoverTheRecord) {
  const Looked looked = looked_at("healthy_flow", 1);
  std::vector<double> places;
  for (const EffectPtr& effect : nominate_gain_changes(looked.data, looked.fit)) {
    places.push_back(
        tests::value_of(effect->parameters(looked.data, tests::Series{0.1}, 1.0), "at"));
  }
  for (double truth = 0.15 * 4096; truth < 0.85 * 4096; truth += 100.0) {
    EXPECT_TRUE(std::ranges::any_of(
        places, [&](double at) { return std::abs(at - truth) <= 4096.0 / 16; }));
  }
}

TEST(Nominate, ShortRecordsNominateWithinThemselves) {
  const tests::Series op = tests::stepping_op(400, 1);
  const LoopData data = make_loop_data(
      tests::process_record(tests::one_lag(0.6, 2), 1.2, op, tests::white_noise(400, 2)), op, 1.0);
  const Fit fit = evaluate(data, tests::structure_of(tests::one_lag(0.6, 2)));
  for (const EffectPtr& effect : nominate_load_steps(data, fit)) {
    EXPECT_LT(*effect->moment(), 400U);
  }
  for (const EffectPtr& effect : nominate_oscillations(data, fit)) {
    const double period = dynamic_cast<const ExternalOscillation&>(*effect).period_samples();
    EXPECT_GT(period, 2.0);
    EXPECT_LT(period, 400.0);
  }
}

/// Of a held sensor as of any other, in samples of op.
TEST(Nominate, OfAHeldSensorPlacesAndPeriodsAreInSamples) {
  const simulate::LoopRecord record = simulate::simulate_scenario("load_upsets", {}, 1);
  const LoopData data = make_loop_data(record.pv, record.op, 1.0, {6, 0});
  const Fit fit = evaluate(data, tests::structure_of(tests::noiseless_process()));
  for (const EffectPtr& effect : nominate_load_steps(data, fit)) {
    EXPECT_EQ(*effect->moment() % 6, 0U);
  }
  const simulate::LoopRecord other = simulate::simulate_scenario("outside_oscillation", {}, 1);
  const LoopData line = make_loop_data(other.pv, other.op, 1.0, {6, 0});
  double nearest = 1e9;
  for (const EffectPtr& effect : nominate_oscillations(
           line, evaluate(line, tests::structure_of(tests::noiseless_process())))) {
    const double period = dynamic_cast<const ExternalOscillation&>(*effect).period_samples();
    nearest = std::min(nearest, std::abs(period - 60.0));
  }
  EXPECT_LT(nearest, 0.5);
}

}  // namespace
}  // namespace loopscope::core::model
