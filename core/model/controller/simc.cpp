#include "core/model/controller/simc.hpp"

#include <algorithm>
#include <stdexcept>

namespace loopscope::core::model {
namespace {

/// Skogestad's first-order model of the process.
struct FirstOrder {
  double lag_s = 0.0;
  double delay_s = 0.0;
};

FirstOrder half_rule(const ProcessFit& fit, double interval_s) {
  const double delay_s = std::max(fit.delay_s, interval_s);
  if (fit.integrating) return {0.0, delay_s + fit.time_constant_s};
  const auto [fast_s, slow_s] = std::minmax(fit.time_constant_s, fit.second_time_constant_s);
  return {slow_s + 0.5 * fast_s, delay_s + 0.5 * fast_s};
}

}  // namespace

ControllerLaw simc_law(const ProcessFit& fit, double interval_s) {
  if (!(interval_s > 0.0) || fit.gain == 0.0) {
    throw std::invalid_argument("SIMC: interval has to be > 0, gain not 0");
  }
  const auto [lag_s, delay_s] = half_rule(fit, interval_s);
  const double tightest_s = 2.0 * delay_s;  // closed-loop time constant plus dead time
  const double integral_s = fit.integrating ? 4.0 * tightest_s : std::min(lag_s, 4.0 * tightest_s);
  ControllerLaw law;
  law.found = true;
  law.gain = (fit.integrating ? 1.0 : lag_s) / (fit.gain * tightest_s);
  // A process that answers within a sample has no lag: the rules leave pure integral action.
  law.integral =
      integral_s > 0.0 ? law.gain * interval_s / integral_s : interval_s / (fit.gain * tightest_s);
  return law;
}

}  // namespace loopscope::core::model
