#pragma once

#include <cstddef>
#include <span>

namespace loopscope::core::loop {

/// How far and how often the controller drove the valve over the pairs of neighbouring samples that
/// are both recorded.
struct ValveWork {
  double travel = 0.0;     ///< sum |op(k) - op(k-1)|, units of op
  double reversals = 0.0;  ///< changes of direction
  std::size_t pairs = 0;   ///< pairs that were counted: the time base of both figures
};

/// Smallest difference that is a move: values stored in single precision are rounded at 6e-8 of
/// their size, so less than 1e-6 of the largest |value| is rounding, neither travel's direction nor
/// a reversal. In the unit of `positions`; 0 when none is recorded.
[[nodiscard]] double move_tolerance(std::span<const double> positions);

/// `op` may hold NaN. The direction is remembered across gaps and across stretches at rest.
[[nodiscard]] ValveWork measure_valve_work(std::span<const double> op);

}  // namespace loopscope::core::loop
