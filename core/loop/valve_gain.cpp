#include "core/loop/valve_gain.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/signal/order/sort_values.hpp"

namespace loopscope::core::loop {
namespace {

/// Percentiles instead of extremes: one spike must not look like a swing.
constexpr double kLowerShare = 0.01;
constexpr double kUpperShare = 0.99;

std::vector<double> sorted_recorded(std::span<const double> samples) {
  std::vector<double> values;
  values.reserve(samples.size());
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(values),
               [](double v) { return std::isfinite(v); });
  signal::sort_values(values);
  return values;
}

std::optional<double> central_span(const std::vector<double>& sorted) {
  if (sorted.empty()) return std::nullopt;
  const auto last = static_cast<double>(sorted.size() - 1);
  const auto at = [&](double share) {
    return sorted[static_cast<std::size_t>(std::lround(share * last))];
  };
  return at(kUpperShare) - at(kLowerShare);
}

double mean_absolute(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += std::abs(value) / static_cast<double>(values.size());
  return sum;
}

}  // namespace

ValveGain measure_valve_gain(std::span<const double> pv, std::span<const double> op_percent,
                             std::optional<double> pv_range) {
  ValveGain gain;
  gain.op_span_percent = central_span(sorted_recorded(op_percent));
  const std::vector<double> pv_values = sorted_recorded(pv);
  const std::optional<double> pv_span = central_span(pv_values);
  const double level = mean_absolute(pv_values);
  if (pv_span && level > 0.0) gain.pv_relative_span = *pv_span / level;
  if (pv_span && pv_range && *pv_range > 0.0) gain.pv_span_percent = 100.0 * *pv_span / *pv_range;
  return gain;
}

}  // namespace loopscope::core::loop
