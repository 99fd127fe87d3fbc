#include "tests/core/model/residual_tests/pass_rates.hpp"

#include <cstdint>

#include "core/model/residual_tests/run_residual_tests.hpp"
#include "core/simulate/scenario.hpp"

namespace loopscope::core::model::tests {

void count(const std::vector<TestOutcome>& answers, PassRates& rates) {
  for (const TestOutcome& answer : answers) {
    PassCounts& counts = rates[std::string(answer.question.name)];
    ++counts.asked;
    for (std::size_t i = 0; i < kLevels.size(); ++i)
      counts.passed[i] += answer.question.p <= kLevels[i] ? 1 : 0;
  }
}

PassRates sizes(White kind, std::size_t samples, std::size_t records) {
  PassRates rates;
  for (std::uint64_t seed = 1; seed <= records; ++seed) {
    const Questionable loop = closed_loop(white(kind, samples, 131 * seed), seed);
    count(test_residual(loop.view()), rates);
  }
  return rates;
}

PassRates powers(const std::string& scenario, std::size_t records) {
  PassRates rates;
  for (std::uint64_t seed = 1; seed <= records; ++seed) {
    const auto record = simulate::simulate_scenario(scenario, {}, seed);
    count(test_residual(arx_residual(record).view()), rates);
  }
  return rates;
}

}  // namespace loopscope::core::model::tests
