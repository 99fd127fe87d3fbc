#include "core/plant/periodogram.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/loop/real_transform.hpp"
#include "core/signal/gaps.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::plant {
namespace {

/// Of the longest stretch from the first to the last recorded sample; gaps are bridged.
signal::Samples bridged(std::span<const double> error) {
  signal::Samples samples(error.begin(), error.end());
  signal::discard_infinite(samples);
  const auto recorded = [](double value) { return !std::isnan(value); };
  samples.erase(std::find_if(samples.rbegin(), samples.rend(), recorded).base(), samples.end());
  samples.erase(samples.begin(), std::find_if(samples.begin(), samples.end(), recorded));
  signal::bridge_gaps(samples, samples.size());
  return samples;
}

/// Takes mean and slope off and applies a Hann window.
void window(signal::Samples& samples) {
  const auto count = static_cast<double>(samples.size());
  const double middle = (count - 1.0) / 2.0;
  double mean = 0.0, moment = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    mean += samples[k] / count;
    moment += samples[k] * (static_cast<double>(k) - middle);
  }
  const double slope = moment * 12.0 / (count * (count * count - 1.0));
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double off = static_cast<double>(k) - middle;
    samples[k] = (samples[k] - mean - slope * off) *
                 (0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * off / (count + 1.0)));
  }
}

}  // namespace

Periodogram hann_periodogram(std::span<const double> error, std::size_t fewest) {
  Periodogram found;
  signal::Samples samples = bridged(error);
  const auto spread = signal::measure_spread(samples);
  if (samples.size() < fewest || !spread || spread->constant()) return found;
  const std::size_t length = loop::fast_length(samples.size());
  found.samples = static_cast<double>(samples.size());
  found.stretch = static_cast<double>(length) / found.samples;
  window(samples);
  const auto spectrum = loop::RealTransform(length).forward(std::move(samples));
  for (const auto& value : spectrum) found.power.push_back(std::norm(value));
  found.power.front() = 0.0;
  return found;
}

}  // namespace loopscope::core::plant
