#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/model/residual_tests/statistics/test_outcome.hpp"
#include "tests/core/model/residual_tests/loops.hpp"

/// How often each question of a residual says yes.
namespace loopscope::core::model::tests {

inline constexpr std::array kWhites = {White::gaussian, White::exponential, White::laplace,
                                       White::modulated, White::garch};

inline constexpr std::array kLevels = {0.05, 0.01, 0.001};
struct PassCounts {
  int asked = 0;
  std::array<int, kLevels.size()> passed{};  ///< at each level
};
using PassRates = std::map<std::string, PassCounts, std::less<>>;  ///< by question

void count(const std::vector<TestOutcome>& answers, PassRates& rates);

/// Of right models.
[[nodiscard]] PassRates sizes(White kind, std::size_t samples, std::size_t records);
/// Of ARX models of a scenario.
[[nodiscard]] PassRates powers(const std::string& scenario, std::size_t records);

}  // namespace loopscope::core::model::tests
