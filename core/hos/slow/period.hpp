#pragma once

#include <optional>
#include <span>

#include "core/hos/kernels/kernels.hpp"

namespace loopscope::core::hos {

/// Shortest period, in samples, that leaves room for a third harmonic below half the sampling rate.
inline constexpr double kShortestPeriod = 8.0;
/// Fewest cycles in the record that a coherence over segments can be taken from.
inline constexpr double kFewestCycles = 9.0;

/// Period, in samples, at which the signal has most power per octave; where bands stand clearly
/// above their neighbourhood, of the most powerful of these. It is meant to catch the fundamental
/// of a limit cycle; a signal without one gets the period at which it wanders most.
///
/// The choice looks at powers only, never at phases, so that a test of phase coupling made at the
/// period keeps its null. NaN and infinity are missing samples. From kShortestPeriod to the
/// record's length by kFewestCycles; nullopt when the record is too short for any period or has no
/// variance.
[[nodiscard]] std::optional<double> dominant_period(std::span<const double> signal,
                                                    const Kernels& kernels = best_kernels());

}  // namespace loopscope::core::hos
