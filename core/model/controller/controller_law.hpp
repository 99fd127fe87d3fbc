#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <string>

namespace loopscope::core::model {

/// What is recorded of one controller, on one grid, equally long. NaN = missing; the error is NaN
/// in manual too.
struct ControllerRecord {
  std::span<const double> error;  ///< sp - pv, pv units
  std::span<const double> sp;     ///< pv units; empty = not recorded, error has an unknown offset
  std::span<const double> op;     ///< % (or op units without a range)
  bool op_in_percent = true;      ///< 0 and 100 are limits
};

/// op(k) - op(k-1) = gain (e(k-lag) - e(k-lag-1)) + integral e(k-lag) - derivative (second
/// difference of pv), as the recorded samples show it.
///
/// A controller that scans faster than the historian integrates between samples; its gain then
/// reads low by half the integral per sample, and the law is still the one that the samples obey.
struct ControllerLaw {
  bool found = false;           ///< a PI (P, I, PID) law explains half of op's moves or more
  double gain = 0.0;            ///< Kc, % per pv unit, signed
  double integral = 0.0;        ///< I, % per pv unit and sample; 0 = none found
  double derivative = 0.0;      ///< on pv, % sample per pv unit; 0 = none found
  double gain_error = 0.0;      ///< standard error of the gain
  double integral_error = 0.0;  ///< of the integral
  std::size_t lag = 0;          ///< 0: acts on the error of the same sample, 1: of the one before
  double setpoint_weight = 1;   ///< share of the gain that set-point moves see; 0 = gain on pv only
  double explained = 0.0;       ///< share of op's moves over `span` samples, 0 to 1
  std::size_t span = 1;         ///< samples between the two ends of the moves that were compared
  std::size_t rows = 0;         ///< moves compared
  std::string statement;        ///< one sentence with the figures
};

/// Fits the law to moves of op over 1 to 64 samples and keeps the shortest span that explains as
/// much as the best: rounding, compression, dead zones and scans between samples blur short moves
/// and average out of long ones. Moves that touch a gap, manual or a limit of op are left out;
/// jumps that no law explains (bumpless transfers) are trimmed. Throws std::invalid_argument for
/// series of different lengths.
[[nodiscard]] ControllerLaw find_controller_law(const ControllerRecord& record);

/// C(exp(iw)) at w radians per sample, 0 < w <= pi.
[[nodiscard]] std::complex<double> response(const ControllerLaw& law, double w);

}  // namespace loopscope::core::model
