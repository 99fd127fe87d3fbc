#pragma once

#include <cstddef>

#include "core/model/record/loop_data.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// Finds load steps that come when the loop answers its setpoint (`Step::setpoint_chance`).
///
/// A load knows nothing of the setpoint. What the model lacks in the answer to a move - a dead time
/// that was another one, a gain, a bend that no effect fits - begins a dead time after the move,
/// and a load step at the place is what explains it best. So where c is the share of the record
/// that lies from shortly before a move (of a ramp: its beginning and its end) to two dead times
/// after it, and k of n load steps begin there, the chance of those k is that of k or more out of n
/// at any time: binomial. Steps that close together are one. A setpoint that moves all the time has
/// c near 1, and a chance near 1. Nothing answers what it does in
/// manual, and moves by less than a tenth of pv's standard deviation do not count.
///
/// `samples_per_row`: of the rows on which the steps were placed.
void find_steps_after_moves(const ModelInput& input, std::size_t samples_per_row,
                            Explanation& explanation);

}  // namespace loopscope::core::model
