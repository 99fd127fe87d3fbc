#include "core/model/controller/controller_law.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

#include "core/simulate/random.hpp"
#include "tests/core/model/known_loops.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using known::Records;
using known::Series;

using loopscope::tests::kNaN;

Records healthy(std::uint64_t seed = 1) {
  return known::run(known::scenario("healthy_flow").settings, seed);
}

Series rounded(Series series, double step) {
  for (double& value : series) value = step * std::round(value / step);
  return series;
}

/// The controller alone: op that a law makes of a wandering pv and a moving set point.
Records controlled(const std::function<double(const Records&, std::size_t)>& op_move,
                   std::uint64_t seed = 1) {
  simulate::GaussianSource noise(seed);
  constexpr std::size_t kSamples = 2000;
  Records r{Series(kSamples), Series(kSamples, 50.0), Series(kSamples, 50.0), Series(kSamples)};
  double wandering = 0.0;
  for (std::size_t k = 0; k < kSamples; ++k) {
    wandering = 0.9 * wandering + 0.3 * noise.next();
    r.sp[k] += k % 400 < 200 ? 0.0 : 3.0;
    r.pv[k] = r.sp[k] + wandering;
    r.error[k] = r.sp[k] - r.pv[k];
    if (k > 2) r.op[k] = r.op[k - 1] + op_move(r, k);
  }
  return r;
}

double change(const Series& series, std::size_t k) {
  return series[k] - series[k - 1];
}

TEST(ControllerLaw, EveryScenarioGivesItsOwnLaw) {
  for (const char* name : {"paper_5_1", "paper_5_4_kano", "healthy_flow", "level_loop", "deadband",
                           "tight_tuning", "sluggish_tuning", "worn_valve", "saturated_valve"}) {
    const known::KnownLoop loop = known::scenario(name);
    const ControllerLaw found = known::find_law(known::run(loop.settings, 1));
    EXPECT_TRUE(found.found) << name;
    EXPECT_EQ(found.lag, 0U) << name;
    EXPECT_NEAR(found.gain, loop.law.gain, 1e-6) << name;
    EXPECT_NEAR(found.integral, loop.law.integral, 1e-6) << name;
    EXPECT_NEAR(found.explained, 1.0, 1e-6) << name;
  }
}

TEST(ControllerLaw, LagOfOneSample) {
  Records records = healthy();
  records.op.insert(records.op.begin(), records.op.front());
  records.op.pop_back();
  const ControllerLaw law = known::find_law(records);
  EXPECT_EQ(law.lag, 1U);
  EXPECT_NEAR(law.gain, 0.27, 1e-6);
}

TEST(ControllerLaw, GainOnly) {
  const ControllerLaw law = known::find_law(
      controlled([](const Records& r, std::size_t k) { return 2.0 * change(r.error, k); }));
  EXPECT_TRUE(law.found);
  EXPECT_NEAR(law.gain, 2.0, 1e-6);
  EXPECT_EQ(law.integral, 0.0);
  EXPECT_EQ(law.derivative, 0.0);
}

TEST(ControllerLaw, GainOnPvAloneShowsAsSetpointWeight) {
  const ControllerLaw law = known::find_law(controlled(
      [](const Records& r, std::size_t k) { return -2.0 * change(r.pv, k) + 0.1 * r.error[k]; }));
  EXPECT_NEAR(law.gain, 2.0, 1e-6);
  EXPECT_NEAR(law.integral, 0.1, 1e-6);
  EXPECT_NEAR(law.setpoint_weight, 0.0, 1e-6);
}

TEST(ControllerLaw, DerivativeOnPv) {
  const ControllerLaw law = known::find_law(controlled([](const Records& r, std::size_t k) {
    return change(r.error, k) + 0.1 * r.error[k] - 3.0 * (change(r.pv, k) - change(r.pv, k - 1));
  }));
  EXPECT_NEAR(law.gain, 1.0, 1e-6);
  EXPECT_NEAR(law.derivative, 3.0, 1e-6);
}

TEST(ControllerLaw, WithoutSetpointTheOffsetIsFound) {
  Records records = healthy();
  for (double& error : records.error) error += 5.0;  // of an unknown set point
  records.sp.clear();
  const ControllerLaw law = known::find_law(records);
  EXPECT_NEAR(law.gain, 0.27, 1e-6);
  EXPECT_NEAR(law.integral, 0.14, 1e-6);
}

TEST(ControllerLaw, ManualGapsAndJumpsAreLeftOut) {
  Records records = healthy();
  for (std::size_t k = 1000; k < 2000; ++k) records.error[k] = kNaN;
  for (std::size_t k = 1000; k < 2000; ++k) records.op[k] = 30.0;
  for (std::size_t k = 100; k < 200; k += 10) records.op[k] = kNaN;
  for (std::size_t k = 3000; k < records.op.size(); ++k) records.op[k] += 7.0;  // bumpless transfer
  const ControllerLaw law = known::find_law(records);
  EXPECT_NEAR(law.gain, 0.27, 1e-6);
  EXPECT_NEAR(law.integral, 0.14, 1e-6);
}

TEST(ControllerLaw, OpAtItsLimitsIsLeftOut) {
  known::KnownLoop loop = known::scenario("saturated_valve");
  Records records = known::run(loop.settings, 2);
  const double high = *std::ranges::max_element(records.op) - 5.0;
  for (double& op : records.op) op = std::min(op, high);
  const ControllerLaw law = known::find_law(records);
  EXPECT_NEAR(law.gain, loop.law.gain, 0.02 * loop.law.gain);
}

struct Blur {
  const char* name;
  std::function<void(Records&)> apply;
  double gain_error;  ///< share of the true gain
};

TEST(ControllerLaw, SurvivesTheHistorian) {
  const Blur blurs[] = {
      {"op rounded to 0.1", [](Records& r) { r.op = rounded(r.op, 0.1); }, 0.05},
      {"op rounded to 0.5", [](Records& r) { r.op = rounded(r.op, 0.5); }, 0.25},
      {"pv rounded to 0.2", [](Records& r) { r.pv = rounded(r.pv, 0.2); }, 0.1},
      // The sum of held errors runs half a sample ahead: the gain reads high by half the integral.
      {"every sample twice",
       [](Records& r) {
         for (std::size_t k = 1; k < r.pv.size(); k += 2) {
           r.pv[k] = r.pv[k - 1];
           r.op[k] = r.op[k - 1];
         }
       },
       0.4},
  };
  for (const Blur& blur : blurs) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Records records = healthy(seed);
      blur.apply(records);
      records.renew_error();
      const ControllerLaw law = known::find_law(records);
      EXPECT_TRUE(law.found) << blur.name;
      EXPECT_NEAR(law.gain, 0.27, 0.27 * blur.gain_error) << blur.name << " seed " << seed;
      EXPECT_NEAR(law.integral, 0.14, 0.014) << blur.name << " seed " << seed;
    }
  }
}

TEST(ControllerLaw, ScanFasterThanTheHistorianKeepsTheIntegral) {
  known::KnownLoop loop = known::scenario("level_loop");
  loop.settings.recorded_samples *= 5;
  const Records fast = known::run(loop.settings, 1);
  Records slow;
  for (std::size_t k = 0; k < fast.pv.size(); k += 5) {
    slow.pv.push_back(fast.pv[k]);
    slow.sp.push_back(fast.sp[k]);
    slow.op.push_back(fast.op[k]);
    slow.error.push_back(fast.error[k]);
  }
  const ControllerLaw law = known::find_law(slow);
  EXPECT_NEAR(law.integral, 5.0 * loop.law.integral, 0.02);
  // Between samples the integral works half an interval ahead.
  EXPECT_NEAR(law.gain, loop.law.gain - 0.5 * 4.0 * loop.law.integral, 0.05);
}

TEST(ControllerLaw, IndependentSignalsHaveNone) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Records records = healthy(seed);
    records.op = known::run(known::scenario("healthy_flow").settings, seed + 1000).op;
    EXPECT_FALSE(known::find_law(records).found) << seed;
  }
}

TEST(ControllerLaw, OpThatLeadsIsNoController) {
  // Nothing controls: op wanders by itself, and pv answers it one sample later.
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    simulate::GaussianSource noise(seed);
    Records records = healthy();
    double op = 0.0, pv = 0.0;
    for (std::size_t k = 0; k < records.op.size(); ++k) {
      pv = 0.8 * pv + 0.3 * op;
      op = 0.99 * op + 0.1 * noise.next();
      records.op[k] = 50.0 + op;
      records.pv[k] = 50.0 + pv + 0.05 * noise.next();
    }
    records.renew_error();
    EXPECT_FALSE(known::find_law(records).found) << seed;
  }
}

TEST(ControllerLaw, ConstantAndEmptyRecordsHaveNone) {
  Records records = healthy();
  records.op.assign(records.op.size(), 40.0);
  EXPECT_FALSE(known::find_law(records).found);
  EXPECT_FALSE(find_controller_law({}).found);
  records.op.pop_back();
  EXPECT_THROW((void)known::find_law(records), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::model
