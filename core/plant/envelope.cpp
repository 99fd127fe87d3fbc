#include "core/plant/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::plant {
namespace {

using Complex = std::complex<double>;

constexpr double kWindowPeriods = 2.0;
/// Of a window's weight; with less, gaps shape the amplitude more than the loop does.
constexpr double kLeastRecorded = 0.7;
/// In a period; what folds over into the means is a tenth and less then.
constexpr double kFewestMeans = 16.0;

/// One window's sums over the recorded samples.
struct Sums {
  Complex rotated = 0.0;   // of w x exp(-i phase)
  Complex rotation = 0.0;  // of w exp(-i phase)
  double value = 0.0;      // of w x
  double weight = 0.0;     // of w
  double full = 0.0;       // of w, were everything recorded

  void add(double w, double x, Complex phase) {
    rotated += w * x * phase;
    rotation += w * phase;
    value += w * x;
    weight += w;
  }
  /// With the window's own mean taken off, which matters where samples are missing.
  [[nodiscard]] Complex amplitude() const {
    if (!(weight >= kLeastRecorded * full)) return {signal::kMissing, signal::kMissing};
    return (rotated - value / weight * rotation) / weight;
  }
};

/// Samples at even distances.
template <typename Value>
struct Series {
  std::span<const Value> values;
  double interval_s = 1.0;
  double start_s = 0.0;
};

/// exp(-2 pi i f t); whole turns are taken off before the digits of half a century are lost in
/// them.
Complex turn(double frequency_hz, double time_s) {
  return std::polar(1.0, -2.0 * std::numbers::pi * std::fmod(time_s * frequency_hz, 1.0));
}

template <typename Value>
Complex amplitude_at(const Series<Value>& series, double frequency_hz, double time_s) {
  const double half_s = 0.5 * kWindowPeriods / frequency_hz;
  const double from = std::ceil((time_s - half_s - series.start_s) / series.interval_s);
  const double to = std::floor((time_s + half_s - series.start_s) / series.interval_s);
  if (from < 0.0 || to >= static_cast<double>(series.values.size()))
    return {signal::kMissing, signal::kMissing};
  const double first_s = series.start_s + from * series.interval_s;
  Complex phase = turn(frequency_hz, first_s);
  Complex taper = std::polar(1.0, std::numbers::pi * (first_s - time_s) / half_s);
  const Complex phase_step = turn(frequency_hz, series.interval_s);
  const Complex taper_step = std::polar(1.0, std::numbers::pi * series.interval_s / half_s);
  Sums sums;
  for (auto k = static_cast<std::size_t>(from); k <= static_cast<std::size_t>(to); ++k) {
    const double w = 0.5 + 0.5 * taper.real();
    sums.full += w;
    if (std::isfinite(series.values[k])) sums.add(w, static_cast<double>(series.values[k]), phase);
    phase *= phase_step;
    taper *= taper_step;
  }
  return sums.amplitude();
}

/// `gain`: what the series has of the frequency, to be divided by.
template <typename Value>
Envelope envelope_of(const Series<Value>& series, double frequency_hz, double gain) {
  Envelope envelope;
  envelope.frequency_hz = frequency_hz;
  const double step_s = envelope.step_s();
  const double half_s = 0.5 * kWindowPeriods / frequency_hz;
  const double last_s =
      series.start_s + (static_cast<double>(series.values.size()) - 1.0) * series.interval_s;
  envelope.first = static_cast<std::int64_t>(std::ceil((series.start_s + half_s) / step_s));
  const auto last = static_cast<std::int64_t>(std::floor((last_s - half_s) / step_s));
  if (last < envelope.first) return envelope;
  envelope.points.reserve(static_cast<std::size_t>(last - envelope.first) + 1);
  for (std::int64_t j = envelope.first; j <= last; ++j)
    envelope.points.emplace_back(
        amplitude_at(series, frequency_hz, static_cast<double>(j) * step_s) / gain);
  return envelope;
}

/// Written without branches: the compiler does several at a time.
template <typename Value>
std::vector<float> means_of_two(std::span<const Value> values) {
  std::vector<float> means(values.size() / 2);
  for (std::size_t k = 0; k < means.size(); ++k) {
    const auto one = static_cast<double>(values[2 * k]);
    const auto other = static_cast<double>(values[2 * k + 1]);
    const bool has_one = std::isfinite(one), has_other = std::isfinite(other);
    const double sum = (has_one ? one : 0.0) + (has_other ? other : 0.0);
    const double mean = has_one && has_other ? 0.5 * sum : sum;
    means[k] =
        has_one || has_other ? static_cast<float>(mean) : std::numeric_limits<float>::quiet_NaN();
  }
  return means;
}

/// Whether means of two samples that lie so far apart are fine enough for the frequency.
bool means_will_do(double interval_s, double frequency_hz) {
  return 2.0 * interval_s * frequency_hz * kFewestMeans <= 1.0;
}

/// Envelope of means of two, of those of four ..., as far as they are fine enough.
template <typename Value>
Envelope envelope_of_means(const Series<Value>& series, double frequency_hz, double gain = 1.0) {
  if (!means_will_do(series.interval_s, frequency_hz))
    return envelope_of(series, frequency_hz, gain);
  const std::vector<float> means = means_of_two(series.values);
  // Of two samples that lie an interval apart.
  gain *= std::cos(std::numbers::pi * frequency_hz * series.interval_s);
  return envelope_of_means(
      Series<float>{means, 2.0 * series.interval_s, series.start_s + 0.5 * series.interval_s},
      frequency_hz, gain);
}

}  // namespace

Envelope make_envelope(std::span<const double> error, double sample_interval_s,
                       std::int64_t start_us, double frequency_hz) {
  const double periods = static_cast<double>(error.size()) * sample_interval_s * frequency_hz;
  if (!(sample_interval_s * frequency_hz * kShortestPeriod <= 1.0 && periods >= kFewestPeriods)) {
    Envelope none;
    none.frequency_hz = frequency_hz;
    return none;
  }
  return envelope_of_means(
      Series<double>{error, sample_interval_s, static_cast<double>(start_us) * 1e-6}, frequency_hz);
}

Envelope make_envelope(const MemberLoop& loop, double frequency_hz) {
  return make_envelope(loop.error, loop.sample_interval_s, loop.start_us, frequency_hz);
}

std::complex<double> Envelope::at(std::int64_t point) const {
  if (point < first || point >= end()) return {signal::kMissing, signal::kMissing};
  return std::complex<double>(points[static_cast<std::size_t>(point - first)]);
}

}  // namespace loopscope::core::plant
