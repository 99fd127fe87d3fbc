#include "core/model/controller/inverse_controller_fit.hpp"

#include <gtest/gtest.h>

#include "tests/core/model/known_loops.hpp"
#include "tests/support/chance.hpp"
#include "tests/support/long_run.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::at_least;
using loopscope::tests::at_most;

constexpr int kRandomLoops = 100;
int random_loops() {
  return static_cast<int>(loopscope::tests::records(kRandomLoops));
}

TEST(InverseControllerFit, InverseOfTheLawHasDistanceZero) {
  const known::Records records = known::run(known::scenario("healthy_flow").settings, 1);
  const ControllerLaw law = known::find_law(records);
  // pv = -op / C = -(1 - z^-1) / (Kc (1 - z^-1) + I) op.
  const double sum = law.gain + law.integral;
  const SampledProcess inverse{{-1.0 / sum, 1.0 / sum}, {1.0, -law.gain / sum}, 0};
  const InverseControllerFit trap = judge_inverse_controller_fit(inverse, law, records.op);
  EXPECT_NEAR(trap.distance, 0.0, 1e-9);
  EXPECT_TRUE(trap.refused);
  EXPECT_FALSE(trap.statement.empty());
}

TEST(InverseControllerFit, NaiveFitsAreCaught) {
  for (const int order : {1, 2}) {
    int caught = 0;
    for (int seed = 1; seed <= random_loops(); ++seed) {
      const auto s = static_cast<std::uint64_t>(seed);
      const known::Records records = known::run(known::random_loop(s).settings, s);
      const SampledProcess naive = known::fit_without_delay(records, order);
      caught += judge_inverse_controller_fit(naive, known::find_law(records), records.op).refused;
    }
    EXPECT_GE(caught, at_least(95, kRandomLoops, random_loops())) << "order " << order;
  }
}

TEST(InverseControllerFit, RightModelsAreKept) {
  int refused = 0;
  for (int seed = 1; seed <= random_loops(); ++seed) {
    const auto s = static_cast<std::uint64_t>(seed);
    const known::KnownLoop loop = known::random_loop(s);
    const known::Records records = known::run(loop.settings, s);
    const ProcessFit fit = known::off_by_a_fifth(loop.process, s);
    refused += judge_inverse_controller_fit(fit, known::find_law(records), records.op, 1.0).refused;
  }
  EXPECT_LE(refused, at_most(2, kRandomLoops, random_loops()));
}

TEST(InverseControllerFit, RightModelsOfPlantLoopsAreKept) {
  for (const char* name : {"healthy_flow", "worn_valve", "paper_5_3", "tight_tuning", "level_loop",
                           "paper_5_2_excessive", "sluggish_tuning", "outside_oscillation"}) {
    const known::KnownLoop loop = known::scenario(name);
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const known::Records records = known::run(loop.settings, seed);
      const ProcessFit fit = known::off_by_a_fifth(loop.process, seed);
      const InverseControllerFit trap =
          judge_inverse_controller_fit(fit, known::find_law(records), records.op, 1.0);
      EXPECT_FALSE(trap.refused) << name << " seed " << seed << " distance " << trap.distance;
    }
  }
}

TEST(InverseControllerFit, PositiveFeedbackIsRefused) {
  const known::KnownLoop loop = known::scenario("healthy_flow");
  const known::Records records = known::run(loop.settings, 1);
  ProcessFit reversed = loop.process;
  reversed.gain = -reversed.gain;
  const InverseControllerFit trap =
      judge_inverse_controller_fit(reversed, loop.law, records.op, 1.0);
  EXPECT_TRUE(trap.wrong_sign);
  EXPECT_TRUE(trap.refused);
}

TEST(InverseControllerFit, WithoutALawNothingIsRefused) {
  const known::Records records = known::run(known::scenario("healthy_flow").settings, 1);
  EXPECT_FALSE(judge_inverse_controller_fit(known::paper_process(), {}, records.op).refused);
}

}  // namespace
}  // namespace loopscope::core::model
