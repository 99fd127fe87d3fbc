#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/diagnosis/verdict.hpp"

/// Verdicts of loops of core/simulate by the branch without coupling.
namespace loopscope::core::diagnosis::tests {

inline constexpr std::array kHealthy{"healthy_flow", "paper_5_1", "paper_5_2_printed",
                                     "level_loop"};
inline constexpr std::array kFaulty{"tight_tuning",   "outside_oscillation", "paper_5_3",
                                    "sticking_valve", "square_limit_cycle",  "paper_5_2_excessive",
                                    "paper_5_4_kano"};

/// The verdict of a loop without its coupling, which has calibrated tests of its own.
[[nodiscard]] Verdict uncoupled(const std::string& scenario, std::uint64_t seed);

/// Whether the plant's list has it.
[[nodiscard]] bool shown(const Verdict& verdict);

/// p that a loop brings into the family: of its verdict, or 1 where nothing is shown.
[[nodiscard]] double p_in_family(const Verdict& verdict);

}  // namespace loopscope::core::diagnosis::tests
