#pragma once

#include <nlohmann/json.hpp>

#include "daemon/lab/calibrate/calibration.hpp"

namespace loopscope::daemon {

/// For scripts: {"records", "levels", "tests": [..], "families": [..], "cost", "plants": [..]};
/// keys in the README of this folder. All but "cost" repeats from run to run.
[[nodiscard]] nlohmann::ordered_json calibration_json(const Calibration& calibration);

}  // namespace loopscope::daemon
