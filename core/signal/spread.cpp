#include "core/signal/spread.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace loopscope::core::signal {
namespace {

/// Differences below this share of a value's size are rounding: conversions from text and scaling
/// leave a few units in the last place of a double (2e-16).
constexpr double kRelativeRounding = 1e-12;

std::vector<double> recorded(std::span<const double> samples) {
  std::vector<double> values;
  values.reserve(samples.size());
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(values),
               [](double v) { return std::isfinite(v); });
  return values;
}

}  // namespace

bool Spread::constant() const {
  return high - low <= kRelativeRounding * std::max(std::abs(low), std::abs(high));
}

std::optional<Spread> measure_spread(std::span<const double> samples) {
  const std::vector<double> values = recorded(samples);
  if (values.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  Spread spread{0.0, 0.0, *low, *high};
  const auto count = static_cast<double>(values.size());
  for (const double v : values) spread.mean += v / count;
  // Deviations relative to the largest one: values near the limits of double must not overflow.
  const double largest = std::max(spread.high - spread.mean, spread.mean - spread.low);
  if (largest > 0.0) {
    double sum = 0.0;
    for (const double v : values)
      sum += ((v - spread.mean) / largest) * ((v - spread.mean) / largest);
    spread.std = largest * std::sqrt(sum / count);
  }
  return spread;
}

std::optional<double> smallest_step(std::span<const double> samples) {
  std::vector<double> values = recorded(samples);
  std::sort(values.begin(), values.end());
  std::optional<double> step;
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double difference = values[k] - values[k - 1];
    const double rounding =
        kRelativeRounding * std::max(std::abs(values[k]), std::abs(values[k - 1]));
    if (difference > rounding && (!step || difference < *step)) step = difference;
  }
  return step;
}

std::size_t longest_flat_run(std::span<const double> samples) {
  std::size_t longest = 0;
  std::size_t run = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const bool goes_on = k > 0 && samples[k] == samples[k - 1];
    run = std::isnan(samples[k]) ? 0 : (goes_on ? run + 1 : 1);
    longest = std::max(longest, run);
  }
  return longest;
}

}  // namespace loopscope::core::signal
