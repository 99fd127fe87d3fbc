#pragma once

#include <cstddef>

#include "core/loop/ar_model.hpp"

namespace loopscope::core::loop {

/// Middle (geometric mean over the plausible delays) of the Harris index that a loop must have to
/// count as well tuned here: paper_5_2_printed, the least of the well tuned loops of
/// core/simulate, has 0.65, sluggish_tuning 0.30.
inline constexpr double kWellTunedHarris = 0.6;

/// Probability that a loop whose true middle index is kWellTunedHarris shows one of `middle` or
/// less (above 0) by chance; 1 for `middle` at or above that, and without `delay` samples.
///
/// The error of `samples` recorded samples is, by its model, a fast part, the first `delay` terms
/// of the impulse response, which no controller can touch, and a slow one, the rest. The odds slow
/// : fast are a ratio of two variance estimates, whose degrees of freedom follow from the parts'
/// autocorrelations: `samples` / sum of rho(k)^2 over all lags (Bartlett). So p is the tail of an F
/// distribution. A model without a finite response gives 1: nothing is claimed.
[[nodiscard]] double harris_p(double middle, const ArModel& model, std::size_t delay,
                              double samples);

}  // namespace loopscope::core::loop
