#pragma once

#include <cstdint>

namespace loopscope::core {

/// What is known of a loop beside its samples.
struct LoopFacts {
  bool integrating = false;  ///< level loop: the vessel integrates
  /// Of the simulations behind p-values (core/hos/significance.hpp); made from the loop and the
  /// window, so that a replay is identical.
  std::uint64_t seed = 0;
};

}  // namespace loopscope::core
