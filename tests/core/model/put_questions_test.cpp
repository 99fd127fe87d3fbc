#include "core/model/put_questions.hpp"

#include <gtest/gtest.h>
#include <span>
#include <string_view>

#include "core/model/baseline.hpp"
#include "core/simulate/scenario.hpp"

namespace loopscope::core::model {
namespace {

double of_linear_loop(std::string_view scenario, std::uint64_t seed) {
  const auto record = simulate::simulate_scenario(scenario, {}, seed);
  const LoopData data = make_loop_data(record.pv, record.op, record.sample_interval_s);
  return p_of_op_direction(data, search_process(data, {}));
}

TEST(PutQuestions, OpsDirectionMattersToALoopWithPlayAndToNoHealthyOne) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_LT(of_linear_loop("deadband", seed), 1e-6) << seed;
  int healthy = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    healthy += of_linear_loop("healthy_flow", seed) < 0.05 ? 1 : 0;
  }
  EXPECT_LE(healthy, 4);  // one in twenty by chance
}

/// Residuals are there at the renewals only; op is read there too.
TEST(PutQuestions, OfAHeldSensorOpsDirectionIsReadAtTheRenewals) {
  const auto record = simulate::simulate_scenario("deadband", {}, 1);
  const LoopData held = make_loop_data(record.pv, record.op, record.sample_interval_s, {3, 0});
  const double p = p_of_op_direction(held, search_process(held, {}));
  EXPECT_GE(p, 0.0);
  EXPECT_LE(p, 1.0);
}

TEST(PutQuestions, OfTooFewSamplesNothingIsAsked) {
  const auto record = simulate::simulate_scenario("deadband", {}, 1);
  const std::span<const double> pv(record.pv), op(record.op);
  const LoopData data = make_loop_data(pv.first(150), op.first(150), 1.0);
  EXPECT_EQ(p_of_op_direction(data, evaluate(data, {})), 1.0);
}

}  // namespace
}  // namespace loopscope::core::model
