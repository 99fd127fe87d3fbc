#pragma once

#include <span>

#include "core/model/valve_trial.hpp"

namespace loopscope::core::model {

/// One way to go from a valve, in steps that are a share of S.
struct ValveMove {
  double band, jump;
};
/// S, J by four steps since J is flatter, and both.
[[nodiscard]] std::span<const ValveMove> any_move();
/// S alone; with J = 0 that stays play.
[[nodiscard]] std::span<const ValveMove> band_moves();

/// Goes the best way by steps of that share of S for as long as it helps, three times at most.
void climb(const ValveRecords& records, ValveRecords::Entry& entry, Trial& trial, double step,
           std::span<const ValveMove> moves);

/// The best on that entry of all valves of the same J / S whose S lies 12 % below to 20 % above, in
/// steps of 0.6 %. He's valve rests at every sample, so a cycle that hardly varies hides its S
/// between values a percent apart, and no climb leads there.
[[nodiscard]] Trial best_band_around(const ValveRecords& records, ValveRecords::Entry& entry,
                                     const Trial& trial);

}  // namespace loopscope::core::model
