#include "core/model/residual_tests/run_residual_tests.hpp"

#include <gtest/gtest.h>
#include <span>
#include <string_view>

#include "core/model/fit/baseline.hpp"
#include "core/simulate/scenario.hpp"

namespace loopscope::core::model {
namespace {

std::vector<TestOutcome> answers_of(std::string_view scenario, std::uint64_t seed,
                                    const RowGrid& grid = {}) {
  const auto record = simulate::simulate_scenario(scenario, {}, seed);
  const LoopData data = make_loop_data(record.pv, record.op, record.sample_interval_s, grid);
  const std::vector<double> pv = at_rows(grid, record.pv), op = at_rows(grid, record.op);
  const ModelInput input{pv, op, {}, {}, record.sample_interval_s};
  return run_residual_tests(input, data, search_process(data, {}));
}

TEST(PutQuestions, OpsDirectionMattersToALoopWithPlayAndToNoHealthyOne) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_LT(p_of(answers_of("deadband", seed), "op_direction"), 1e-6) << seed;
  int healthy = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    healthy += p_of(answers_of("healthy_flow", seed), "op_direction") < 0.05 ? 1 : 0;
  EXPECT_LE(healthy, 4);  // one in twenty by chance
}

/// Residuals are there at the renewals only; op is read there too.
TEST(PutQuestions, OfAHeldSensorOpsDirectionIsReadAtTheRenewals) {
  const double p = p_of(answers_of("deadband", 1, {3, 0}), "op_direction");
  EXPECT_GT(p, 0.0);
  EXPECT_LT(p, 1.0);
}

}  // namespace
}  // namespace loopscope::core::model
