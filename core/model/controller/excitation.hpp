#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace loopscope::core::model {

/// What op and pv did. NaN = missing.
struct ExcitationRecord {
  std::span<const double> op;  ///< %, or op units without a range
  std::span<const double> pv;  ///< pv units, as long as op
  bool op_in_percent = true;   ///< false: no range is known, nothing is said of percent
  /// pv as a fitted process makes it from op alone, pv units; empty = none fitted yet.
  std::span<const double> response;
};

/// Whether op moves enough for a model to be claimed.
struct Excitation {
  bool sufficient = false;
  double op_span = 0.0;       ///< 1st to 99th percentile of op, % (or op units)
  double op_steps = 0.0;      ///< the span in steps of op's grid; large for a continuous op
  std::size_t reversals = 0;  ///< turns of op by more than a tenth of its span
  double still_share = 0.0;   ///< of the record in op's longest standstill, 0 to 1
  double shared = 0.0;        ///< R^2 of pv's moves on op's, at the time scale where it is greatest
  /// Standard deviation of the response's moves by that of pv's fastest moves (its noise).
  std::optional<double> response_to_noise;
  std::string statement;  ///< one sentence with the figures
};

/// Throws std::invalid_argument for series of different lengths.
[[nodiscard]] Excitation judge_excitation(const ExcitationRecord& record);

}  // namespace loopscope::core::model
