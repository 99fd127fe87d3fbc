#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/plant/member_loop.hpp"

namespace loopscope::core::plant {

/// What speaks for and against one loop's being where a shared oscillation begins.
struct SourceEvidence {
  double strength = 0.0;           ///< share of the error's variance in the oscillation, 0 to 1
  double valve_explained = 0.0;    ///< as OwnFindings has it
  double outside_explained = 0.0;  ///< likewise
  double valve_blamed = 0.0;       ///< confidence of a verdict that blames the valve; else 0
  double cycle_score = 0.0;        ///< that a sticking valve makes the cycle (core/model), 0 to 1
  double cubic_evidence = 0.0;     ///< -ln p of f + f + f -> 3f in the error, at the period
  bool writes_setpoint = false;    ///< its output is another loop's setpoint: it moves no valve
};

/// `strength` as in SharingLoop; `writes_setpoint` is left false. Takes a few milliseconds: the
/// limit cycle is simulated.
[[nodiscard]] SourceEvidence gather_source_evidence(const MemberLoop& loop, double frequency_hz,
                                                    double strength);

/// The evidence as the ranking weighs it. What speaks of a valve counts in full from a strength of
/// a quarter on, in proportion below: a valve that sticks in another rhythm is not the source.
inline constexpr std::size_t kSourceFigures = 6;
[[nodiscard]] std::array<double, kSourceFigures> figures_of(const SourceEvidence& evidence);

/// In words, with figures, what speaks for the loop first.
[[nodiscard]] std::vector<std::string> reasons_of(const SourceEvidence& evidence);

}  // namespace loopscope::core::plant
