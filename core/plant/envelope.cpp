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

template <typename Value>
Envelope envelope_of(const Series<Value>& series, double frequency_hz) {
  Envelope envelope;
  envelope.frequency_hz = frequency_hz;
  const double step_s = envelope.step_s();
  const double half_s = 0.5 * kWindowPeriods / frequency_hz;
  const double last_s =
      series.start_s + (static_cast<double>(series.values.size()) - 1.0) * series.interval_s;
  envelope.first = static_cast<std::int64_t>(std::ceil((series.start_s + half_s) / step_s));
  const auto last = static_cast<std::int64_t>(std::floor((last_s - half_s) / step_s));
  for (std::int64_t j = envelope.first; j <= last; ++j)
    envelope.points.push_back(amplitude_at(series, frequency_hz, static_cast<double>(j) * step_s));
  return envelope;
}

template <typename Value>
std::vector<float> means_of_two(std::span<const Value> values) {
  std::vector<float> means;
  means.reserve(values.size() / 2);
  for (std::size_t k = 0; k + 1 < values.size(); k += 2) {
    const bool one = std::isfinite(values[k]), other = std::isfinite(values[k + 1]);
    const double sum = (one ? static_cast<double>(values[k]) : 0.0) +
                       (other ? static_cast<double>(values[k + 1]) : 0.0);
    means.push_back(one || other ? static_cast<float>(sum / (one && other ? 2.0 : 1.0))
                                 : std::numeric_limits<float>::quiet_NaN());
  }
  return means;
}

}  // namespace

Demodulator::Demodulator(const MemberLoop& loop)
    : error_(loop.error),
      interval_s_(loop.sample_interval_s),
      start_s_(static_cast<double>(loop.start_us) * 1e-6) {
  Level level{means_of_two(error_), 2.0 * interval_s_, start_s_ + 0.5 * interval_s_};
  while (static_cast<double>(level.means.size()) >= kFewestMeans * kFewestPeriods) {
    Level next{means_of_two(std::span<const float>(level.means)), 2.0 * level.interval_s,
               level.start_s + 0.5 * level.interval_s};
    levels_.push_back(std::move(level));
    level = std::move(next);
  }
}

Envelope Demodulator::envelope(double frequency_hz) const {
  const double periods = static_cast<double>(error_.size()) * interval_s_ * frequency_hz;
  if (!(interval_s_ * frequency_hz * kShortestPeriod <= 1.0 && periods >= kFewestPeriods)) {
    Envelope none;
    none.frequency_hz = frequency_hz;
    return none;
  }
  const Level* level = nullptr;
  double gain = 1.0;
  for (const Level& one : levels_) {
    if (one.interval_s * frequency_hz * kFewestMeans > 1.0) break;
    level = &one;
    // The mean of two samples that lie half an interval of the means apart.
    gain *= std::cos(0.5 * std::numbers::pi * frequency_hz * one.interval_s);
  }
  if (level == nullptr)
    return envelope_of(Series<double>{error_, interval_s_, start_s_}, frequency_hz);
  Envelope envelope =
      envelope_of(Series<float>{level->means, level->interval_s, level->start_s}, frequency_hz);
  for (Complex& z : envelope.points) z /= gain;
  return envelope;
}

Envelope make_envelope(const MemberLoop& loop, double frequency_hz) {
  return Demodulator(loop).envelope(frequency_hz);
}

std::complex<double> Envelope::at(std::int64_t point) const {
  if (point < first || point >= end()) return {signal::kMissing, signal::kMissing};
  return points[static_cast<std::size_t>(point - first)];
}

}  // namespace loopscope::core::plant
