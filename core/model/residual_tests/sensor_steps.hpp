#pragma once

#include <optional>
#include <vector>

#include "core/model/residual_tests/run_residual_tests.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// What the values of pv say of the sensor, beside any model.
struct SensorFinding {
  std::optional<Step> quantisation;
  std::optional<Step> hold;
  std::size_t hold_samples = 1;  ///< the samples that the sensor is renewed after
  /// It stands still again and again, not once.
  [[nodiscard]] bool renewed() const { return hold_samples > 1; }
};

/// Takes the answers to "grid" and "held" for steps where p <= 1e-6; `error` is that of the
/// baseline, pv units squared, and stands before and after each step: a grid need not lower it, and
/// what a held sensor leaves is for the caller to find out.
[[nodiscard]] SensorFinding find_sensor_steps(double error,
                                              const std::vector<TestOutcome>& answers);

}  // namespace loopscope::core::model
