#pragma once

#include <vector>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// Marks isolated outliers of pv, one or two samples long. An outlier is a sample that
/// - stands off the median of its five neighbours by more than ten times the usual such distance
///   (1.4826 MAD over the record, after Hampel 1974), or
/// - stands off that median by more than 2.5 standard deviations of the record, and is not what its
///   neighbours tell (neighbour_errors.hpp) by more than the tail of all such errors (tail_law.hpp)
///   lets expect: of those taken out, one in twenty by chance. Where the signal is louder than
///   usual for 65 samples, such samples stay;
/// and at least half of whose height a linear one-step prediction from the past of pv, op and sp
/// does not foresee (loop_prediction.hpp): a tight loop answers its setpoint with peaks of two
/// samples. Steps, ramps and the edges and tips of limit cycles keep their neighbours on one side
/// and are left alone.
///
/// One spike of eight standard deviations makes every record look nonlinear; in one that is nearly
/// white the median of neighbours is too noisy to show it. When there are more outliers than 1.5 %
/// of the samples, that is how the signal is, and none is marked.
///
/// `op` and `sp` are as long as pv, or empty; NaN = missing.
[[nodiscard]] std::vector<bool> find_spikes(const Samples& pv, const Samples& op,
                                            const Samples& sp);

}  // namespace loopscope::core::signal
