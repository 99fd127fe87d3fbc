#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/model/valve_law.hpp"

namespace loopscope::core::model {

/// One loop's record at its sample interval. Equal lengths; NaN = missing.
struct ValveSearchInput {
  std::span<const double> pv;         ///< pv units
  std::span<const double> op;         ///< %
  std::span<const std::uint8_t> fit;  ///< nonzero: pv may be fitted here; the rest is unseen
};

/// A valve that explains the record, and where pv puts it right.
struct ValveCandidate {
  Valve valve;
  /// Twice the gain in log likelihood over mv = op on the fitted rows, less the price of the
  /// corrections. Comparable within one search only.
  double evidence = 0.0;
  double residual_ratio = 1.0;  ///< residual sum of squares over that with mv = op
  std::size_t corrections = 0;  ///< positions that the law alone would not have
  /// For run_valve(valve, restarts, op, mv); chosen on the fitted rows only.
  std::vector<ValveRestart> restarts;
  std::size_t samples_per_row = 1;  ///< of the means that it was judged on
};

struct ValveSearchResult {
  std::vector<ValveCandidate> candidates;  ///< best first, at most two of each law
  std::optional<ValveCandidate> deadband;  ///< the best with J = 0
};

/// Valves that make op explain pv better than op itself does. Nothing when op never swings, no rows
/// are left to fit, or nothing is better. False candidates are to be expected: they are judged on
/// what they do to rows outside `fit`. The same input gives the same result.
/// Throws std::invalid_argument for unequal lengths.
[[nodiscard]] ValveSearchResult search_valve(const ValveSearchInput& input);

}  // namespace loopscope::core::model
