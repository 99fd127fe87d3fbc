#include "core/model/residual_tests/statistics/centred.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/signal/order/spread.hpp"

namespace loopscope::core::model {
namespace {

std::vector<double> without_infinite(std::span<const double> signal) {
  std::vector<double> values(signal.begin(), signal.end());
  for (double& value : values)
    if (!std::isfinite(value)) value = std::numeric_limits<double>::quiet_NaN();
  return values;
}

}  // namespace

std::optional<Centred> centred(std::span<const double> signal, std::size_t fewest) {
  Centred result;
  result.values = without_infinite(signal);
  const std::optional<signal::Spread> spread = signal::measure_spread(result.values);
  if (!spread || spread->constant() || !std::isfinite(spread->std)) return std::nullopt;
  result.mean = spread->mean;
  result.std = spread->std;
  for (double& value : result.values) {
    const bool recorded = !std::isnan(value);
    result.recorded += recorded ? 1 : 0;
    value = recorded ? (value - result.mean) / result.std : 0.0;
  }
  if (result.recorded < fewest) return std::nullopt;
  return result;
}

std::vector<double> high_passed(std::span<const double> signal) {
  std::vector<double> result(signal.size(), std::numeric_limits<double>::quiet_NaN());
  double mean = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < signal.size(); ++k) {
    if (!std::isfinite(signal[k])) continue;
    if (std::isnan(mean)) mean = signal[k];
    result[k] = signal[k] - mean;
    mean += result[k] / kMemorySamples;
  }
  return result;
}

std::vector<double> sorted_finite(std::span<const double> signal) {
  std::vector<double> sorted;
  for (const double value : signal)
    if (std::isfinite(value)) sorted.push_back(value);
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

std::vector<double> increments(std::span<const double> signal) {
  std::vector<double> result(signal.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 1; k < signal.size(); ++k) result[k] = signal[k] - signal[k - 1];
  return result;
}

}  // namespace loopscope::core::model
