#pragma once

#include "core/model/controller/controller_law.hpp"
#include "core/model/controller/sampled_process.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// The loop that the law makes with the process, `interval_s` apart.
///
/// The dominant poles are those that carry most energy of pv's answer to a step of the load (at
/// the process output; of an integrating process at its input); where the sensitivity peaks above
/// 2, those nearest to the peak: a slow real pole beside them may have more energy, but it is they
/// that noise keeps ringing. Settling is that of the slowest
/// pole, dominant or not. An unstable loop has infinite sensitivity and settling, and the damping
/// (negative) and period of its fastest growing poles. `slowness` is not filled. Of a ProcessFit
/// with more than 25 samples of delay the loop is computed on a coarser grid with the same integral
/// time. Throws std::invalid_argument unless interval_s > 0, and every figure of a ProcessFit is
/// finite.
[[nodiscard]] ClosedLoop close_loop(const SampledProcess& process, const ControllerLaw& law,
                                    double interval_s);
[[nodiscard]] ClosedLoop close_loop(const ProcessFit& fit, const ControllerLaw& law,
                                    double interval_s);

/// Denominator of the closed loop in z^-1.
[[nodiscard]] Polynomial characteristic(const SampledProcess& process, const ControllerLaw& law);

}  // namespace loopscope::core::model
