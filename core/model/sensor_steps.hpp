#pragma once

#include <optional>
#include <vector>

#include "core/model/fit.hpp"
#include "core/model/question_residual.hpp"

namespace loopscope::core::model {

/// What the values of pv say of the sensor, beside any model.
struct SensorFinding {
  std::vector<Step> steps;  ///< sensor_quantisation, sensor_hold
  /// Of a held sensor only the renewed samples say anything: the rows that are left.
  std::optional<Rows> rows;
};

/// Takes the answers to "grid" and "held" for steps where they are clear. A grid need not lower the
/// error; what a held sensor leaves is predicted by the last value between its renewals.
[[nodiscard]] SensorFinding find_sensor_steps(const LoopData& data, const Fit& baseline,
                                              const std::vector<Answer>& answers);

}  // namespace loopscope::core::model
