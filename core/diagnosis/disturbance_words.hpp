#pragma once

#include <cstddef>
#include <string>

#include "core/model/results/explanation.hpp"

namespace loopscope::core::diagnosis {

/// What comes from outside. A wave has a source with the same period in another loop; a load that
/// moves has a time, and one that keeps moving has neither.
enum class Disturbance {
  none,         ///< no step of the explanation comes from outside
  wave,         ///< sinusoids explain most of what comes from outside
  moved_once,   ///< a load step
  moved,        ///< several, after which nothing sudden is left
  keeps_moving  ///< load steps, and the residual test for sudden loads still passes at 0.01
};

/// Of an explanation's steps and of its residual tests, by what the steps explain.
[[nodiscard]] Disturbance disturbance_of(const model::Explanation& explanation);

/// Load steps apart from each other by more than the process takes to answer: delay and slowest
/// time constant, of a vessel the delay alone.
[[nodiscard]] std::size_t load_moves(const model::Explanation& explanation);

struct DisturbanceWords {
  std::string summary;  ///< one sentence
  std::string action;
};

/// Of anything but `none`.
[[nodiscard]] DisturbanceWords words_of(Disturbance disturbance,
                                        const model::Explanation& explanation);

}  // namespace loopscope::core::diagnosis
