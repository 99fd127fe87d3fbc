#pragma once

#include <cstddef>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// Makes isolated outliers missing and returns how many there were: samples that stand off the
/// median of their five neighbours by more than ten times the usual such distance (1.4826 MAD over
/// the record, after Hampel 1974). Steps, ramps and the edges of limit cycles keep their neighbours
/// on one side and are left alone.
///
/// One spike of eight standard deviations makes every record look nonlinear; ten times the usual
/// distance is beyond what 4096 Gaussian samples reach by chance. When more than 1 % of the samples
/// stand off, that is how the signal is, and nothing is touched.
std::size_t discard_spikes(Samples& samples);

}  // namespace loopscope::core::signal
