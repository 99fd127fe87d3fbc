#pragma once

#include <algorithm>

namespace loopscope::tests::generators {

struct PiTuning {
  double gain = 1.0;
  double integral_time = 10.0;
};

/// SIMC (Skogestad 2003) for a first-order process with dead time; `response` = the closed loop's
/// time constant and the dead time together, in the unit of `lag`.
[[nodiscard]] inline PiTuning simc_of_lag(double process_gain, double lag, double response) {
  return {lag / (process_gain * response), std::min(lag, 4.0 * response)};
}

}  // namespace loopscope::tests::generators
