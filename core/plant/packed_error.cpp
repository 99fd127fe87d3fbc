#include "core/plant/packed_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/signal/gaps.hpp"

namespace loopscope::core::plant {
namespace {

constexpr std::int16_t kMissingStep = std::numeric_limits<std::int16_t>::min();
constexpr double kLastStep = std::numeric_limits<std::int16_t>::max();

/// Within the range but for rounding, which matters where that is a few of the smallest differences
/// that numbers of this size can have.
std::int16_t nearest_step(double steps) {
  return static_cast<std::int16_t>(std::lround(std::clamp(steps, -kLastStep, kLastStep)));
}

}  // namespace

ErrorAbout error_about(const signal::PreparedLoop& loop) {
  return signal::count_recorded(loop.sp) > 0 ? ErrorAbout::setpoint : ErrorAbout::own_mean;
}

PackedError::PackedError(std::span<const double> error, double sample_interval_s,
                         std::int64_t start_us, ErrorAbout about)
    : sample_interval_s_(sample_interval_s), start_us_(start_us), about_(about) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const double value : error)
    if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
  if (least <= most) {
    // Halves: the difference of two finite numbers may be infinite.
    middle_ = 0.5 * least + 0.5 * most;
    step_ = (0.5 * most - 0.5 * least) / kLastStep;
  }
  steps_.reserve(error.size());
  for (const double value : error)
    steps_.push_back(!std::isfinite(value) ? kMissingStep
                     : step_ > 0.0         ? nearest_step((value - middle_) / step_)
                                           : std::int16_t{0});
}

signal::Samples PackedError::unpacked() const {
  signal::Samples samples(steps_.size());
  std::ranges::transform(steps_, samples.begin(), [this](std::int16_t steps) {
    return steps == kMissingStep ? signal::kMissing : middle_ + step_ * steps;
  });
  return samples;
}

Envelope PackedError::envelope(double frequency_hz) const {
  return make_envelope(unpacked(), sample_interval_s_, start_us_, frequency_hz);
}

}  // namespace loopscope::core::plant
