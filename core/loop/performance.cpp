#include "core/loop/performance.hpp"

#include <cmath>

#include "core/loop/error_memory.hpp"
#include "core/loop/harris.hpp"
#include "core/loop/if_finite.hpp"
#include "core/loop/valve_work.hpp"
#include "core/loop/variance_error.hpp"
#include "core/signal/control_state.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::loop {
namespace {

constexpr double kSecondsPerHour = 3600.0;

std::optional<double> auto_fraction_of(std::span<const signal::ControlMode> mode) {
  const signal::ModeCounts modes = signal::count_modes(mode);
  if (modes.known() == 0) return std::nullopt;
  return static_cast<double>(modes.automatic) / static_cast<double>(modes.known());
}

}  // namespace

Performance measure_performance(std::span<const double> error, std::span<const double> op_percent,
                                std::span<const signal::ControlMode> mode, double sample_interval_s,
                                const PerformanceSettings& settings) {
  Performance result;
  if (const auto spread = signal::measure_spread(error)) result.error_std = if_finite(spread->std);
  result.error_log_variance_se = log_variance_error(error);
  if (const auto harris = measure_harris(error, settings.min_delay_samples,
                                         settings.max_delay_samples, settings.ar_order)) {
    result.harris_low = harris->low;
    result.harris_high = harris->high;
    result.harris_p = harris->p;
  }
  if (const auto memory = error_memory_samples(error))
    result.error_memory_s = if_finite(*memory * sample_interval_s);
  result.longest_delay_s = static_cast<double>(settings.max_delay_samples) * sample_interval_s;
  if (const ValveWork work = measure_valve_work(op_percent); work.pairs > 0) {
    const double hours = static_cast<double>(work.pairs) * sample_interval_s / kSecondsPerHour;
    result.valve_travel_per_h = if_finite(work.travel / hours);
    result.reversals_per_h = if_finite(work.reversals / hours);
  }
  result.auto_fraction = auto_fraction_of(mode);
  return result;
}

}  // namespace loopscope::core::loop
