#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::core::diagnosis {

/// What is seen in the data themselves, before any cause is weighed.
enum class LoopState {
  none,
  stands_still,     ///< pv does: a dead transmitter, `sensor_fault`
  held_at_limit,    ///< op is at an end of its range under a lasting error, `valve_saturation`
  not_controlling,  ///< no controller acts: manual, or the output is constant
};

/// The first that applies, in the order above; none where too little was recorded to say.
[[nodiscard]] LoopState state_of(const Evidence& evidence);

/// In sentences, the most important first; empty for `none`.
[[nodiscard]] std::vector<std::string> state_text(LoopState state, const Evidence& evidence);

/// A measurement that stands still (evidence.still is filled), in one sentence, and what to do.
[[nodiscard]] std::string frozen_summary(const Evidence& evidence);
[[nodiscard]] std::string frozen_action();

/// The same of a loop without a controller.
[[nodiscard]] std::string not_controlling_summary(const Evidence& evidence);
[[nodiscard]] std::string not_controlling_action(const Evidence& evidence);

/// Log odds (natural, ln 900) that a state seen in the data gives its cause: nine in ten of the
/// loops with that fault show it, and at most one window in a thousand of those without
/// (tests/core/signal/state_rates_test.cpp).
[[nodiscard]] double state_evidence();

}  // namespace loopscope::core::diagnosis
