#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::model {

/// The process between valve and sensor, apart from its gain: dead time and one or two lags, or
/// an integrator and a lag.
///
///     y(k) = (n0 + n1 z^-1) s(k),   s(k) = z^-delay L1 L2 f(k),
///     L = (1 - p) / (1 - p z^-1), an integrator 1 / (1 - z^-1)
///
/// The numerator stands for the part of the dead time that is no whole sample, and for a zero as in
/// the paper's eq. 20.
struct ProcessShape {
  std::size_t delay_samples = 1;              ///< >= 1: without one, the fit finds the controller
  bool integrating = false;                   ///< the first lag is an integrator
  double pole = 0.0;                          ///< of the first lag, 0 to 0.999; 1 when integrating
  double second_pole = 0.0;                   ///< 0 = first order
  std::array<double, 2> numerator{1.0, 0.0};  ///< n0 + n1 = 1: what the last fit found
};

/// s, the response before the numerator, to the input, which before the record was at its first
/// value.
void respond(const ProcessShape& shape, std::span<const double> input, std::span<double> response);

/// (n0 + n1 z^-1) of a response, in place.
void weigh(const std::array<double, 2>& numerator, std::span<double> response);

/// y, the whole response of gain 1.
[[nodiscard]] std::vector<double> answer(const ProcessShape& shape, std::span<const double> input);

/// One lag of unit gain, in place, from rest at the first value.
void lag(double pole, std::span<double> signal);

}  // namespace loopscope::core::model
