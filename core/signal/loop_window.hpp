#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace loopscope::core::signal {

/// One value per grid slot; a missing value is NaN, never a filled-in number.
using Samples = std::vector<double>;

/// The missing value of Samples.
inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// How the controller was run at one sample; historians store the numbers.
enum class ControlMode : std::uint8_t { manual = 0, automatic = 1, cascade = 2, unknown = 3 };

/// The controller output, or a transmitter, at 0 % and at 100 %, in its units; low < high.
struct OpRange {
  double low = 0.0;
  double high = 100.0;
};

/// What is known of pv from the time before a window.
struct PvPast {
  double longest_flat_s = 0.0;  ///< longest run of equal values, seconds; 0 = none
  double step = 0.0;            ///< by which it moves at least, pv units; 0 = not known
};

/// What was recorded of one control loop on a uniform grid: the input of every analysis.
///
/// `pv` sets the length; each other series is either empty (not recorded) or exactly as long.
/// Sample k was taken at start_us + k * sample_interval_s.
struct LoopWindow {
  double sample_interval_s = 1.0;  ///< seconds, > 0
  std::int64_t start_us = 0;       ///< first sample, microseconds UTC since 1970
  Samples sp;                      ///< setpoint, pv units
  Samples pv;                      ///< process variable, its own units
  Samples pv_rows;  ///< pv where a row lies, else NaN; empty = pv holds nothing between its rows
  Samples op;       ///< controller output, op units
  Samples mv;       ///< valve position, op units
  std::vector<ControlMode> mode;    ///< empty = not recorded
  std::optional<OpRange> op_range;  ///< nullopt = the catalogue does not say
  std::optional<PvPast> pv_past;    ///< nullopt = nothing is known
  std::size_t repeated_times = 0;   ///< rows dropped because a later row had the same time

  [[nodiscard]] std::size_t size() const { return pv.size(); }
};

}  // namespace loopscope::core::signal
