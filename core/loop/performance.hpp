#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::loop {

/// How well the loop does its work, and how hard the valve works for it.
struct Performance {
  /// Harris index: minimum-variance over actual variance of the error, 0 (poor) to 1 (as good as
  /// any linear controller), as a range over the plausible delays.
  std::optional<double> harris_low, harris_high;
  /// Probability that a well tuned loop shows a middle index this small by chance (harris_p.hpp).
  std::optional<double> harris_p;
  std::optional<double> error_std;  ///< pv units
  /// Standard error of ln(error_std^2) (variance_error.hpp).
  std::optional<double> error_log_variance_se;
  /// How long the error remembers (error_memory.hpp), seconds.
  std::optional<double> error_memory_s;
  double longest_delay_s = 0.0;              ///< longest plausible delay, of the settings
  std::optional<double> valve_travel_per_h;  ///< sum |op(k) - op(k-1)|, % of op range per hour
  /// Changes of op's direction per hour; moves below 1e-6 of the largest |op| are rounding. Both
  /// rates are per hour of neighbouring samples that are recorded.
  std::optional<double> reversals_per_h;
  std::optional<double>
      auto_fraction;  ///< automatic or cascade, of the samples whose mode is known; 0 to 1
  std::optional<double> at_limit_fraction;  ///< share of samples with op at a limit, 0 to 1
};

/// 1 <= min_delay_samples <= max_delay_samples.
struct PerformanceSettings {
  std::size_t min_delay_samples = 2;   ///< a sampled loop answers after one sample at the earliest
  std::size_t max_delay_samples = 10;  ///< longest plausible delay
  std::size_t ar_order = 20;           ///< of the error model that the index is read from
};

/// `error` (pv units) and `op_percent` (empty when not recorded or without a range: op units then)
/// may hold NaN; `mode` is empty when not recorded. Figures that cannot be computed are nullopt;
/// at_limit_fraction is for who knows the range (core/signal/judge_quality).
[[nodiscard]] Performance measure_performance(std::span<const double> error,
                                              std::span<const double> op_percent,
                                              std::span<const signal::ControlMode> mode,
                                              double sample_interval_s,
                                              const PerformanceSettings& settings = {});

}  // namespace loopscope::core::loop
