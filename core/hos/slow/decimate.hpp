#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::hos {

/// Frequencies up to this pass, in cycles per kept sample: the fourth harmonic of a wave of twelve
/// kept samples a cycle. Their gain is 1 within 0.001.
inline constexpr double kDecimationPassband = 1.0 / 3.0;

/// Half the support of the low-pass, in kept samples: this many are lost at either end.
inline constexpr std::size_t kDecimationHalfSupport = 12;

/// Every `factor`-th sample of the signal behind a linear-phase low-pass.
///
/// The low-pass (a sinc in a Kaiser window, 24 factor + 1 taps) keeps the passband above and is
/// 60 dB down from 0.5 cycles per kept sample on, so that nothing folds over; being symmetric it
/// shifts no phase against another, so that couplings stay what they were. Kept sample k lies at
/// sample (12 + k) factor. Where missing samples (NaN, infinity) carry more than 5 % of the
/// absolute weights, the kept sample is missing (NaN); otherwise the weights of the recorded ones
/// are raised to the sum 1 again.
///
/// Returns floor((size - 1) / factor) - 23 kept samples, none for a shorter signal; `factor` 1
/// keeps the signal as it is. Sums of samples beyond 1e307 may overflow and are then missing.
/// Throws std::invalid_argument for factor 0.
[[nodiscard]] std::vector<double> decimate(std::span<const double> signal, std::size_t factor);

}  // namespace loopscope::core::hos
