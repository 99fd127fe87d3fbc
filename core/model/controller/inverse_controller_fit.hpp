#pragma once

#include <span>
#include <string>

#include "core/model/controller/controller_law.hpp"
#include "core/model/controller/sampled_process.hpp"

namespace loopscope::core::model {

/// Whether a process fitted from op to pv is the controller run backwards.
struct InverseControllerFit {
  bool refused = false;
  /// Between the fit G and -1/C over the band where op moves, gain and shape together: 0 = the
  /// same, 1 = nothing in common; below 0.5 the fit is refused.
  double distance = 1.0;
  /// G and C make positive feedback: no loop with this process and this law stays where it is.
  bool wrong_sign = false;
  std::string statement;  ///< why, with the figures; empty when not refused
};

/// Without set-point moves op and pv obey the law of the controller at every sample, so a fit that
/// is free to answer within the sample finds pv = -op / C, almost without error. `op` tells where
/// the comparison counts; NaN = missing. Never refused without a law (`law.found` false).
[[nodiscard]] InverseControllerFit judge_inverse_controller_fit(const SampledProcess& fit,
                                                                const ControllerLaw& law,
                                                                std::span<const double> op);
/// The same; throws std::invalid_argument unless interval_s > 0 and every figure of the fit is
/// finite.
[[nodiscard]] InverseControllerFit judge_inverse_controller_fit(const ProcessFit& fit,
                                                                const ControllerLaw& law,
                                                                std::span<const double> op,
                                                                double interval_s);

}  // namespace loopscope::core::model
