#pragma once

#include <span>

#include "core/model/valve_law/valve_law.hpp"

namespace loopscope::core::model {

/// A stem on friction behind an actuator whose pressure follows the held op with a first-order lag,
/// looked at several times between two samples (i counts the looks):
///
///     P(i) = P(i-1) + a (op - P(i-1))
///     rests until |P - x| > (S + J) / 2; then x moves towards P - d (S - J) / 2, d its direction
///
/// By `he` it is there at once and rests again, so that it goes in slips; by `kano` it follows with
/// the stem's lag, until it has become slower than `resting_speed` or P turns back. When within a
/// sample a stem breaks loose, and by how much it overshoots, a law of op at the samples does not
/// know: it puts each slip wrong by what op moved in that sample, and keeps the error.
///
/// Before `first_op`, the first op that is no NaN, the pressure stood there. Requires
/// !valve.acts_at_samples() and law `he` or `kano`; as run_valve otherwise.
void run_between_samples(const Valve& valve, double first_op, std::span<const double> op,
                         std::span<double> mv);

}  // namespace loopscope::core::model
