#include "core/plant/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::plant {
namespace {

using Complex = std::complex<double>;

constexpr double kWindowPeriods = 3.0;
/// Of a window's weight; with less, gaps shape the amplitude more than the loop does.
constexpr double kLeastRecorded = 0.7;
constexpr double kFewestSamples = 4.0;  // in a period
constexpr double kFewestPeriods = 8.0;  // in a record

/// One window's sums over the recorded samples.
struct Sums {
  Complex rotated = 0.0;   // of w x exp(-i phase)
  Complex rotation = 0.0;  // of w exp(-i phase)
  double value = 0.0;      // of w x
  double weight = 0.0;     // of w
  double full = 0.0;       // of w, were everything recorded

  /// With the window's own mean taken off, which matters where samples are missing.
  [[nodiscard]] Complex amplitude() const {
    if (!(weight >= kLeastRecorded * full)) return {signal::kMissing, signal::kMissing};
    return (rotated - value / weight * rotation) / weight;
  }
};

class Demodulator {
 public:
  Demodulator(const MemberLoop& loop, double frequency_hz)
      : error_(loop.error),
        interval_s_(loop.sample_interval_s),
        start_s_(static_cast<double>(loop.start_us) * 1e-6),
        frequency_hz_(frequency_hz),
        half_s_(0.5 * kWindowPeriods / frequency_hz) {}

  [[nodiscard]] Complex amplitude_at(double time_s) const {
    const double from = std::ceil((time_s - half_s_ - start_s_) / interval_s_);
    const double to = std::floor((time_s + half_s_ - start_s_) / interval_s_);
    if (from < 0.0 || to >= static_cast<double>(error_.size()))
      return {signal::kMissing, signal::kMissing};
    const double offset_s = start_s_ + from * interval_s_ - time_s;
    Complex phase = turn(cycles(start_s_ + from * interval_s_));
    Complex taper = std::polar(1.0, std::numbers::pi * offset_s / half_s_);
    const Complex phase_step = turn(frequency_hz_ * interval_s_);
    const Complex taper_step = std::polar(1.0, std::numbers::pi * interval_s_ / half_s_);
    Sums sums;
    for (auto k = static_cast<std::size_t>(from); k <= static_cast<std::size_t>(to); ++k) {
      const double w = 0.5 + 0.5 * taper.real();
      sums.full += w;
      if (std::isfinite(error_[k])) add(sums, w, error_[k], phase);
      phase *= phase_step;
      taper *= taper_step;
    }
    return sums.amplitude();
  }

 private:
  static void add(Sums& sums, double w, double x, Complex phase) {
    sums.rotated += w * x * phase;
    sums.rotation += w * phase;
    sums.value += w * x;
    sums.weight += w;
  }
  /// Whole turns are taken off before the digits of half a century are lost in them.
  [[nodiscard]] double cycles(double time_s) const {
    return std::fmod(time_s * frequency_hz_, 1.0);
  }
  static Complex turn(double cycles) { return std::polar(1.0, -2.0 * std::numbers::pi * cycles); }

  std::span<const double> error_;
  double interval_s_;
  double start_s_;
  double frequency_hz_;
  double half_s_;
};

}  // namespace

std::complex<double> Envelope::at(std::int64_t point) const {
  if (point < first || point >= end()) return {signal::kMissing, signal::kMissing};
  return points[static_cast<std::size_t>(point - first)];
}

Envelope make_envelope(const MemberLoop& loop, double frequency_hz) {
  Envelope envelope;
  envelope.frequency_hz = frequency_hz;
  const double periods =
      static_cast<double>(loop.error.size()) * loop.sample_interval_s * frequency_hz;
  if (!(loop.sample_interval_s * frequency_hz * kFewestSamples <= 1.0 && periods >= kFewestPeriods))
    return envelope;
  const Demodulator demodulator(loop, frequency_hz);
  const double step_s = envelope.step_s();
  const double start_s = static_cast<double>(loop.start_us) * 1e-6;
  const double half_s = 0.5 * kWindowPeriods / frequency_hz;
  const double last_s =
      start_s + static_cast<double>(loop.error.size() - 1) * loop.sample_interval_s;
  envelope.first = static_cast<std::int64_t>(std::ceil((start_s + half_s) / step_s));
  const auto last = static_cast<std::int64_t>(std::floor((last_s - half_s) / step_s));
  for (std::int64_t j = envelope.first; j <= last; ++j)
    envelope.points.push_back(demodulator.amplitude_at(static_cast<double>(j) * step_s));
  return envelope;
}

}  // namespace loopscope::core::plant
