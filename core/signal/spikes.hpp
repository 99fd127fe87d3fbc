#pragma once

#include <cstddef>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// Makes isolated outliers, one or two samples long, missing and returns how many samples they
/// were. An outlier is a sample that
/// - stands off the median of its five neighbours by more than ten times the usual such distance
///   (1.4826 MAD over the record, after Hampel 1974), or
/// - stands off that median by more than 2.5 standard deviations of the record, and is not what its
///   neighbours tell (neighbour_errors.hpp) by more than the tail of all such errors (tail_law.hpp)
///   lets expect: of those taken out, one in twenty by chance. Where the signal is louder than
///   usual for 65 samples, such samples stay.
/// Steps, ramps and the edges and tips of limit cycles keep their neighbours on one side and are
/// left alone.
///
/// One spike of eight standard deviations makes every record look nonlinear; in one that is nearly
/// white the median of neighbours is too noisy to show it. When there are more outliers than 1.5 %
/// of the samples, that is how the signal is, and nothing is touched.
std::size_t discard_spikes(Samples& samples);

}  // namespace loopscope::core::signal
