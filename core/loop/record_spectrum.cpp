#include "core/loop/record_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/signal/gaps.hpp"

namespace loopscope::core::loop {
namespace {

/// Relative width of a flank. A brick wall would ring beside every sharp edge of the signal.
constexpr double kFlank = 0.1;

void fill_all_gaps(signal::Samples& samples) {
  signal::bridge_gaps(samples, samples.size());
  const auto is_recorded = [](double v) { return !std::isnan(v); };
  const auto first = std::find_if(samples.begin(), samples.end(), is_recorded);
  if (first == samples.end()) {
    // All values were too large to count with.
    std::fill(samples.begin(), samples.end(), 0.0);
    return;
  }
  std::fill(samples.begin(), first, *first);
  const auto last = std::find_if(samples.rbegin(), samples.rend(), is_recorded);
  std::fill(samples.rbegin(), last, *last);
}

void standardise(signal::Samples& samples, const signal::Spread& spread) {
  for (double& value : samples) value = (value - spread.mean) / spread.std;
}

/// Removes the least-squares line.
void remove_trend(signal::Samples& samples) {
  const auto count = static_cast<double>(samples.size());
  const double middle = (count - 1.0) / 2.0;
  double mean = 0.0;
  double moment = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    mean += samples[k] / count;
    moment += samples[k] * (static_cast<double>(k) - middle);
  }
  const double slope = moment * 12.0 / (count * (count * count - 1.0));
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k] -= mean + slope * (static_cast<double>(k) - middle);
  }
}

/// Continues the record to `length` by the mirror image of its end fading into that of its start.
void continue_by_mirrors(signal::Samples& samples, std::size_t length) {
  const std::size_t count = samples.size();
  const std::size_t added = length - count;
  samples.resize(length);
  for (std::size_t j = 0; j < added; ++j) {
    const double weight = static_cast<double>(j + 1) / static_cast<double>(added + 1);
    const double mirrored_end = samples[count - 1 - std::min(j, count - 1)];
    const double mirrored_start = samples[std::min(added - 1 - j, count - 1)];
    samples[count + j] = (1.0 - weight) * mirrored_end + weight * mirrored_start;
  }
}

/// Raised cosine from 0 at `from` to 1 at `to` (either may be the larger).
double flank(double frequency, double from, double to) {
  const double position = std::clamp((frequency - from) / (to - from), 0.0, 1.0);
  return 0.5 - 0.5 * std::cos(std::numbers::pi * position);
}

double gain(double frequency, const Band& band) {
  const double rise = band.low > 0.0 ? flank(frequency, band.low, band.low * (1.0 + kFlank)) : 1.0;
  return rise * flank(frequency, band.high, band.high * (1.0 - kFlank));
}

}  // namespace

std::size_t transform_length(std::size_t samples) {
  return fast_length(samples + samples / 2);
}

RecordSpectrum::RecordSpectrum(std::span<const double> signal, const signal::Spread& spread,
                               RealTransform& transform)
    : recorded_(signal.begin(), signal.end()), transform_(transform), scale_(spread.std) {
  signal::discard_infinite(recorded_);
  signal::Samples samples = recorded_;
  fill_all_gaps(samples);
  standardise(samples, spread);
  remove_trend(samples);
  continue_by_mirrors(samples, transform.length());
  spectrum_ = transform.forward(samples);
  power_.resize(spectrum_.size());
  std::transform(spectrum_.begin(), spectrum_.end(), power_.begin(),
                 [](const std::complex<double>& x) { return std::norm(x); });
}

double RecordSpectrum::bin_width() const {
  return 1.0 / static_cast<double>(transform_.length());
}

double RecordSpectrum::independent_share() const {
  return static_cast<double>(recorded_.size()) * bin_width();
}

signal::Samples RecordSpectrum::component(Band band, std::size_t longest_bridge) {
  RealTransform::Spectrum filtered(spectrum_.size());
  const auto first = static_cast<std::size_t>(band.low / bin_width());
  const auto last =
      std::min(filtered.size(), static_cast<std::size_t>(band.high / bin_width()) + 1);
  for (std::size_t i = first; i < last; ++i) {
    filtered[i] = spectrum_[i] * gain(static_cast<double>(i) * bin_width(), band);
  }
  signal::Samples result = transform_.inverse(std::move(filtered));
  signal::Samples mask = recorded_;
  signal::bridge_gaps(mask, longest_bridge);
  result.resize(mask.size());
  for (std::size_t k = 0; k < result.size(); ++k) {
    result[k] = std::isnan(mask[k]) ? signal::kMissing : result[k] * scale_;
  }
  return result;
}

}  // namespace loopscope::core::loop
