#pragma once

#include <span>
#include <string>

#include "core/plant/shared_oscillation.hpp"

namespace loopscope::core::plant {

/// One event in a few sentences: what, how many, where from and why, what to do. Everything in
/// `event` but the statement is filled.
[[nodiscard]] std::string statement_of(const SharedOscillation& event,
                                       std::span<const MemberLoop> loops);

}  // namespace loopscope::core::plant
