#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/evidence.hpp"

namespace loopscope::core::diagnosis {

/// What the wave shapes and the mv-op and pv-op plots say about the valve.
struct ValvePattern {
  enum class Kind {
    undecided,  ///< nothing speaks clearly for or against the valve
    sticks,     ///< stands still while op moves, then jumps
    dead_band,  ///< loses travel at reversals but follows in between
    follows,    ///< valve position recorded and straight in op
  };
  Kind kind = Kind::undecided;
  bool measured = false;  ///< read from the recorded valve position, not inferred from shapes
  double score = 0.0;     ///< weighted votes for stiction, 0 to 1 (inferred only)
  std::vector<std::string> reasons;
};

/// The mv-op plot decides where the valve position is recorded; else the votes of wave shape,
/// cross-correlation (self-regulating loops only) and pv-op ellipse. Without an oscillation the
/// shapes have no meaning and the pattern stays undecided.
[[nodiscard]] ValvePattern judge_valve(const Evidence& evidence);

}  // namespace loopscope::core::diagnosis
