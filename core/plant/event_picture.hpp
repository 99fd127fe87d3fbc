#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/plant/member_loop.hpp"

namespace loopscope::core::plant {

/// Loops of an event that are drawn at most: more curves nobody tells apart.
inline constexpr std::size_t kMostPictured = 8;
/// What a curve of a few hundred pixels shows.
inline constexpr std::size_t kTraceValues = 240;
inline constexpr std::size_t kSpectrumValues = 120;
/// Enough to see a shape come back, few enough to see its shape.
inline constexpr double kPicturedPeriods = 12.0;

/// One loop of an event as people look at it: how it swings, and at which periods.
struct MemberPicture {
  std::size_t index = 0;      ///< in the loops that were given
  std::int64_t start_us = 0;  ///< middle of the first value, microseconds UTC since 1970
  double step_s = 0.0;        ///< from one value to the next; 0 = there are none
  /// Means of the error, sp - pv, pv units, at most kTraceValues; NaN = nothing recorded.
  std::vector<double> error;
  /// Spectrum of the whole record, shortest period first, at most kSpectrumValues; empty = none can
  /// be computed.
  std::vector<double> periods_s;
  /// At these periods: share of the error's variance per unit of ln(period), >= 0.
  std::vector<double> power;
};

/// The first kMostPictured of `members` (indices into `loops`, strongest first): the last
/// kPicturedPeriods that all of them have, or those of the newest records where they have no two
/// periods in common.
[[nodiscard]] std::vector<MemberPicture> picture_event(double period_s,
                                                       std::span<const std::size_t> members,
                                                       std::span<const MemberLoop> loops);

}  // namespace loopscope::core::plant
