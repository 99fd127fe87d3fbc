#pragma once

#include <optional>
#include <span>

namespace loopscope::core::loop {

/// He, Wang, Pottmann and Qin (2007): every half cycle between two zero crossings is fitted by a
/// sine and by a triangle, each made of two quarter waves that meet at the best peak location, by
/// least squares; the index is the mean of MSE_sine / (MSE_sine + MSE_triangle) over the half
/// cycles. 0 = sine, 1 = triangle, 0.43 = square wave.
///
/// `oscillation` is the signal without drift and sampling noise (band from half the fundamental to
/// about the seventh harmonic), NaN = missing; `period` in samples. Half cycles that touch a gap or
/// are not between a half and one and a half times period / 2 are left out. nullopt when fewer than
/// four are left or a half period is shorter than five samples.
[[nodiscard]] std::optional<double> measure_shape_index(std::span<const double> oscillation,
                                                        double period);

}  // namespace loopscope::core::loop
