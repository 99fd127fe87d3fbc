#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/results/explanation.hpp"

/// What explain() says first of records whose cause is known.
namespace loopscope::core::model::tests {

inline constexpr std::uint64_t kFirstSeed = 7000;

struct Shares {
  std::map<std::string, int> first;  ///< effect of the first step; "none"
  int right = 0, claims = 0;
};
[[nodiscard]] Shares shares_of(std::string_view scenario, const std::vector<EffectKind>& right,
                               std::size_t records);
void print(std::string_view scenario, const Shares& shares);

struct Faulty {
  const char* scenario;
  std::vector<EffectKind> right;
};
void PrintTo(const Faulty& faulty, std::ostream* stream);
[[nodiscard]] const std::vector<Faulty>& faulty_scenarios();

inline constexpr std::array kHealthyScenarios = {
    "paper_5_1",  "paper_5_2_printed", "paper_5_2_excessive", "healthy_flow",
    "level_loop", "tight_tuning",      "sluggish_tuning"};

}  // namespace loopscope::core::model::tests
