#pragma once

#include <optional>

#include "core/loop/correlation.hpp"

namespace loopscope::core::loop {

/// Symmetry of the cross-correlation of op and pv about lag 0.
struct HorchFigures {
  double dtau = 0.0;  ///< |tl - tr| / (tl + tr), 0 (even) to 1 (odd)
  double drho = 0.0;  ///< ||r0| - max|r|| / (|r0| + max|r|), 0 (even) to 1 (odd)
};

/// Horch (1999). tl and tr are the distances from lag 0 to the nearest zero crossing on its left
/// and right, r0 the value at lag 0, max|r| the largest between the two crossings. nullopt when one
/// of the crossings is not within `period` samples: the signals do not oscillate together.
[[nodiscard]] std::optional<HorchFigures> measure_horch(const Correlation& op_pv, double period);

}  // namespace loopscope::core::loop
