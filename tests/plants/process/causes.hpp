#pragma once

#include <cstddef>
#include <optional>

#include "tests/plants/process/plan.hpp"
#include "tests/plants/process/random.hpp"

namespace loopscope::tests::process {

/// A plan and what was put into it.
struct Draft {
  PlantPlan with;                      ///< as it is recorded
  PlantPlan without;                   ///< the same without the cause
  std::optional<std::size_t> source;   ///< the loop whose valve, sensor or controller it is
  std::optional<double> set_period_s;  ///< where the cause brings its own period
};

/// Which valves may stick.
enum class Valves {
  any,
  direct,  ///< that a level, pressure or temperature moves without a flow loop between
};

/// nullopt where this plan has no place for the cause.
[[nodiscard]] std::optional<Draft> put_cause(const PlantPlan& plan, Cause cause, Valves valves,
                                             Random& random);

}  // namespace loopscope::tests::process
