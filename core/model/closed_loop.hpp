#pragma once

#include <complex>
#include <vector>

#include "core/model/controller_law.hpp"
#include "core/model/explanation.hpp"
#include "core/model/sampled_process.hpp"

namespace loopscope::core::model {

/// The loop that the law makes with the process, `interval_s` apart.
///
/// The dominant poles are those that carry most energy of pv's answer to a step of the load (at
/// the process output; of an integrating process at its input). Settling is that of the slowest
/// pole, dominant or not. An unstable loop has infinite sensitivity and settling, and the damping
/// (negative) and period of its fastest growing poles. Above 25 samples of delay the loop is
/// computed on a coarser grid with the same integral time. Throws std::invalid_argument unless
/// interval_s > 0.
[[nodiscard]] ClosedLoop close_loop(const SampledProcess& process, const ControllerLaw& law,
                                    double interval_s);
[[nodiscard]] ClosedLoop close_loop(const ProcessFit& fit, const ControllerLaw& law,
                                    double interval_s);

/// Denominator of the closed loop in z^-1.
[[nodiscard]] Polynomial characteristic(const SampledProcess& process, const ControllerLaw& law);

/// Zeros in z of a polynomial in z^-1 (its constant not 0), those at z = 0 left out.
[[nodiscard]] std::vector<std::complex<double>> zeros(const Polynomial& polynomial);

/// Greatest |1 / (1 + G C)| over 0 < w <= pi, the loop being stable.
[[nodiscard]] double peak_sensitivity(const SampledProcess& process, const ControllerLaw& law);

}  // namespace loopscope::core::model
