#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/model/record/loop_data.hpp"
#include "core/model/vectors/eight_numbers.hpp"

namespace loopscope::core::model {

/// Poles of the lags that are tried, from mean to mean, and delays, means. Lags of up to a hundred
/// means, delays of up to three: a lag that the linear rival lacks looks like a valve that comes
/// late.
inline constexpr std::array kTravelPoles = {0.0, 0.6, 0.85, 0.95, 0.99};
inline constexpr std::array<std::size_t, 3> kTravelDelays = {0, 1, 3};

/// Of flows through one lag, over the means that are fitted.
struct TravelSums {
  EightNumbers sum, with_trend, square, with_pv;
};

/// What fits of slow travel do along records, for one kind of processor; all kinds give the same
/// results, to the last digit.
struct TravelKernel {
  /// lagged[i][k]: the flows through the lag i less their first values.
  void (*lag)(std::span<const EightNumbers> flows, EightNumbers* const* lagged);
  /// Over the `ranges` of means, in order. Every lag rests at its first value for as long as a
  /// delay holds it: the record of a delay is the one without, later.
  TravelSums (*sum)(const EightNumbers* lagged, std::size_t delay, std::span<const Range> ranges,
                    const double* trend, const double* pv);
};

/// The fastest that this processor can run.
[[nodiscard]] const TravelKernel& best_travel_kernel();

}  // namespace loopscope::core::model
