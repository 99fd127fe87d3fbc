#pragma once

#include "core/model/controller/controller_law.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// The PI law that a good engineer would give the process: SIMC rules (Skogestad, J. Process
/// Control 13, 2003), closed-loop time constant = dead time, half of a second lag counted to each.
/// Reverse-acting processes get a negative law. Throws std::invalid_argument unless interval_s > 0
/// and the gain is not 0.
[[nodiscard]] ControllerLaw simc_law(const ProcessFit& fit, double interval_s);

}  // namespace loopscope::core::model
