#pragma once

namespace loopscope::core::loop {

/// The two independent signs of an oscillation as one number. `prominence` is the normal deviate of
/// its spectral peak; `return_deviate` tells how far the autocorrelation comes back after one
/// period beyond the quarter decay of a well-tuned loop, in standard deviations of band noise.
///
/// Their sum: both are normal deviates, and on noise they are all but uncorrelated. A peak that
/// does not come back is a damped resonance, whose prominence grows with the record: there the
/// return alone decides.
[[nodiscard]] double oscillation_strength(double prominence, double return_deviate);

/// Probability that a record with a smooth spectrum (white noise, AR(1), random walk, a well damped
/// loop) is called oscillating at this strength or more: 10^((3.5 - strength) / 1.08), at most 1.
///
/// Not theory but a straight line on the logarithm that lies above the measured tail of every such
/// family down to 1e-4 (README.md, "How sure an oscillation is"). Below, it is the line carried on:
/// the tails bend downwards like those of normal deviates, so that it errs to the safe side. Holds
/// for the default OscillationSettings; stricter ones only make it safer.
[[nodiscard]] double oscillation_p(double strength);

}  // namespace loopscope::core::loop
