#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/signal/prepared_loop.hpp"

namespace loopscope::core::signal {

/// A move of sp in one direction over the samples `first` to `last` in a row.
struct SetpointMove {
  std::size_t first = 0;
  std::size_t last = 0;
  double size = 0.0;  ///< pv units, with its sign
};

/// The size of a move that the window does not show.
inline constexpr double kUnknownSize = std::numeric_limits<double>::infinity();

/// Every move of the setpoint, however small, while the controller is not in manual, in ascending
/// time. A move during a gap counts at the first sample after it. A return from manual is a move of
/// unknown size: what sp did meanwhile (it may have tracked pv) is no step of the loop.
[[nodiscard]] std::vector<SetpointMove> find_setpoint_moves(const PreparedLoop& loop);

/// The same of a setpoint whose controller was never in manual; NaN = missing.
[[nodiscard]] std::vector<SetpointMove> find_setpoint_moves(std::span<const double> sp);

/// Whether the setpoint moves in more than half of the samples: it comes from another controller
/// (cascade, ratio).
[[nodiscard]] bool moves_most_of_the_time(std::span<const double> sp);

}  // namespace loopscope::core::signal
