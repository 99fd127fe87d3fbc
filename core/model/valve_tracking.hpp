#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/model/lagged_fit.hpp"
#include "core/model/op_step.hpp"
#include "core/model/valve_law.hpp"

namespace loopscope::core::model {

/// A record as valves are run on it: `steps_per_row` values of op (%, means over the samples
/// between) for every row of pv.
struct TrackedRecord {
  LaggedRows rows;
  std::vector<double> op;            ///< without NaN: the last value is held
  std::vector<OpStep<float>> steps;  ///< of op, by op_steps()
  std::size_t steps_per_row = 1;
  double linear_residual = 0.0;  ///< of the fit with mv = op
  LaggedModel linear;
};

/// What op does at every sample: for all valves that are tracked alike. Before the record op rose.
[[nodiscard]] std::vector<OpStep<float>> op_steps(std::span<const double> op);

/// A valve followed through a record by what pv says about it.
struct TrackedValve {
  LaggedModel model;
  std::size_t corrections = 0;
  std::vector<ValveRestart> restarts;  ///< at_sample counts values of TrackedRecord::op
  /// rows ln(linear residual / residual) less the price of the corrections; twice the gain in log
  /// likelihood.
  double evidence = 0.0;
};

/// Price of a correction in units of twice the log likelihood.
inline constexpr double kCorrectionPrice = 4.0;

/// Runs the law over op and puts its position right where pv asks for it.
///
/// A law alone keeps every error of its position: the start of the record, which nobody knows, an
/// S or J one percent off, or rounding of op make it slip at other times than the valve did, for
/// the rest of the record. So eight valves run side by side over `rows_per_stretch` rows, one where
/// the law has it and seven elsewhere in the band, and the one whose predictions (by `model`) leave
/// the smallest squares on the counted rows goes on; leaving the law must lower them by
/// kCorrectionPrice residual variances. The rows are then fitted again with that mv.
[[nodiscard]] TrackedValve track_valve(const TrackedRecord& record, const Valve& valve,
                                       const LaggedModel& model, std::size_t rows_per_stretch);

/// The same fit with the law alone.
[[nodiscard]] LaggedModel fit_untracked(const TrackedRecord& record, const Valve& valve);

}  // namespace loopscope::core::model
