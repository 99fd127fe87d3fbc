#pragma once

#include <span>
#include <vector>

namespace loopscope::core::hos {

/// `signal` (NaN = missing) without what keeps its phase to the harmonics of an oscillation: the
/// record as it would be if nothing were coupled, from which surrogates of an uncoupled loop are to
/// be made. A linear model of a square wave has poles at its harmonics, whose lines last for so
/// many cycles that they look locked to each other in every surrogate.
///
/// The phase of the fundamental is followed by two running means over whole periods of
/// x(t) exp(-2 pi i t / period), in which its harmonics vanish; least squares on cosine and sine of
/// twice and three times that phase, the two that are tested (harmonic_test.hpp), are taken off.
/// `period` in samples, at least 8 and at most a quarter of the record.
[[nodiscard]] std::vector<double> without_locked_harmonics(std::span<const double> signal,
                                                           double period);

}  // namespace loopscope::core::hos
