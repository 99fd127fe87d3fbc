#include "core/signal/order/spread.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/signal/order/sort_values.hpp"

namespace loopscope::core::signal {
namespace {

/// Differences below this share of a value's size are rounding: conversions from text and scaling
/// leave a few units in the last place of a double (2e-16).
constexpr double kValueRounding = 1e-12;

std::vector<double> recorded(std::span<const double> samples) {
  std::vector<double> values(samples.size());
  std::size_t count = 0;
  for (const double value : samples) {
    values[count] = value;
    if (std::isfinite(value)) ++count;
  }
  values.resize(count);
  return values;
}

/// Partial results side by side: no sum or comparison waits for the one before it.
constexpr std::size_t kLanes = 8;

/// Calls use(lane, value) for every value, the lanes in turn.
template <typename Use>
void in_lanes(std::span<const double> values, Use use) {
  const std::size_t whole = values.size() / kLanes * kLanes;
  for (std::size_t k = 0; k < whole; k += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) use(lane, values[k + lane]);
  }
  for (std::size_t k = whole; k < values.size(); ++k) use(k - whole, values[k]);
}

using Lanes = std::array<double, kLanes>;

Lanes all_lanes(double value) {
  Lanes lanes;
  lanes.fill(value);
  return lanes;
}

double sum_of(const Lanes& lanes) {
  return std::accumulate(lanes.begin(), lanes.end(), 0.0);
}

bool all_finite(std::span<const double> samples) {
  // x - x is NaN for what is not finite, and NaN stays in a sum.
  Lanes sum{};
  in_lanes(samples, [&](std::size_t lane, double value) { sum[lane] += value - value; });
  return sum_of(sum) == 0.0;
}

double std_about(double mean, double largest, std::span<const double> values) {
  // Deviations relative to the largest one: values near the limits of double must not overflow.
  const double scale = 1.0 / largest;
  if (!std::isfinite(scale)) return 0.0;
  Lanes squares{};
  in_lanes(values, [&](std::size_t lane, double value) {
    const double deviation = (value - mean) * scale;
    squares[lane] += deviation * deviation;
  });
  return largest * std::sqrt(sum_of(squares) / static_cast<double>(values.size()));
}

Spread spread_of(std::span<const double> values) {
  const double weight = 1.0 / static_cast<double>(values.size());
  Lanes mean{};
  Lanes low = all_lanes(values[0]);
  Lanes high = low;
  in_lanes(values, [&](std::size_t lane, double value) {
    mean[lane] += value * weight;
    low[lane] = value < low[lane] ? value : low[lane];
    high[lane] = value > high[lane] ? value : high[lane];
  });
  Spread spread{sum_of(mean), 0.0, *std::ranges::min_element(low), *std::ranges::max_element(high)};
  const double largest = std::max(spread.high - spread.mean, spread.mean - spread.low);
  if (largest > 0.0) spread.std = std_about(spread.mean, largest, values);
  return spread;
}

/// Distance of two values, 0 where it is no more than their rounding.
double step_between(double low, double high) {
  const double rounding = kValueRounding * std::max(std::abs(high), std::abs(low));
  return high - low > rounding ? high - low : 0.0;
}

}  // namespace

bool Spread::constant() const {
  return high - low <= kValueRounding * std::max(std::abs(low), std::abs(high));
}

std::optional<Spread> measure_spread(std::span<const double> samples) {
  if (!samples.empty() && all_finite(samples)) return spread_of(samples);
  const std::vector<double> values = recorded(samples);
  if (values.empty()) return std::nullopt;
  return spread_of(values);
}

std::optional<double> smallest_step(std::span<const double> samples) {
  std::vector<double> values = recorded(samples);
  sort_values(values);
  double smallest = HUGE_VAL;
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double step = step_between(values[k - 1], values[k]);
    if (step > 0.0 && step < smallest) smallest = step;
  }
  return smallest < HUGE_VAL ? std::optional(smallest) : std::nullopt;
}

std::optional<double> smallest_neighbour_step(std::span<const double> samples) {
  double smallest = HUGE_VAL;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const auto [low, high] = std::minmax(samples[k - 1], samples[k]);
    const double step = step_between(low, high);
    if (step > 0.0 && step < smallest) smallest = step;
  }
  return smallest < HUGE_VAL ? std::optional(smallest) : std::nullopt;
}

double share_of_moves(std::span<const double> samples) {
  std::size_t pairs = 0;
  std::size_t moves = 0;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    if (std::isnan(samples[k]) || std::isnan(samples[k - 1])) continue;
    ++pairs;
    if (samples[k] != samples[k - 1]) ++moves;
  }
  return pairs == 0 ? 0.0 : static_cast<double>(moves) / static_cast<double>(pairs);
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
