#pragma once

#include <string>

#include "daemon/lab/calibrate/calibration.hpp"

namespace loopscope::daemon {

/// For people: one table per level with a row per family and a column per test, then what the
/// analysis costs, then the plants.
[[nodiscard]] std::string calibration_text(const Calibration& calibration);

}  // namespace loopscope::daemon
