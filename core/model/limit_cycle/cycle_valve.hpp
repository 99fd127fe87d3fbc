#pragma once

#include <span>
#include <vector>

#include "core/model/limit_cycle/limit_cycle_cause.hpp"
#include "core/model/record/loop_data.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// Natural log odds that the valve makes the loop cycle, from two figures: the shape of the cycle
/// (`cause`), and how much of op's travel in the cycle the band of the valve is that the one-step
/// error shows. A sticking valve turns op about a band apart; a good valve's band is a small part
/// of the travel that something else gives op. `band_percent`: S, or the width of play, > 0.
[[nodiscard]] double odds_that_valve_cycles(const CycleCause& cause, double band_percent);

/// Whether the process is nearer to one that follows the flow at once than to one that integrates
/// it. Behind the latter a loop cycles about play, too.
[[nodiscard]] bool follows_in_cycle(const CycleEvidence& cycle);

/// What the cycle says of the valves that the one-step error shows.
///
/// Play: the one-step error hardly tells it from stiction, but a self-regulating loop with play
/// does not cycle by itself (one whose process integrates in the cycle does). Where the odds are
/// above 0 and op repeats its half cycle better than noise does the step is marked
/// `cycle_indicates_stiction`; clearly better, and more often than the setpoint turns, where that
/// moves op: moves back and forth across play look alike. The effect stays play, which is what the
/// error shows: in front of a lag that the integral action outruns play hunts as well. Stiction:
/// where op repeats its half cycle under a setpoint at rest and the odds are three to one against,
/// the step is marked `cycle_contradicts_valve`: something else makes the loop cycle.
void weigh_valves_by_cycle(const ModelInput& input, std::vector<Step>& steps);

}  // namespace loopscope::core::model
