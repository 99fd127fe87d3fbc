#pragma once

#include <cstdint>
#include <span>

#include "core/model/results/mechanism.hpp"

namespace loopscope::core::model {

struct CycleCause;

/// What was recorded of one loop, on one grid, equally long. NaN = missing.
struct ModelInput {
  std::span<const double> pv;      ///< pv units
  std::span<const double> op;      ///< % of its range, or op units where no range is known
  std::span<const double> sp;      ///< pv units; empty = not recorded
  std::span<const double> error;   ///< sp - pv, pv units; NaN in manual too
  double sample_interval_s = 1.0;  ///< > 0
  bool op_in_percent = true;
  std::uint64_t seed = 0;  ///< of the simulations behind p-values
  Without without{};       ///< tests only
  /// What judge_limit_cycle() says of these series, where it was asked before; nullptr = ask it.
  const CycleCause* cycle = nullptr;
};

}  // namespace loopscope::core::model
