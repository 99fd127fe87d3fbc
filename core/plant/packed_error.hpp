#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/plant/envelope.hpp"
#include "core/signal/loop_window.hpp"
#include "core/signal/prepared_loop.hpp"

namespace loopscope::core::plant {

/// What pv is taken off: where no setpoint is recorded it is the record's own mean, which that of
/// other times does not go on from.
enum class ErrorAbout : std::uint8_t { setpoint, own_mean };

[[nodiscard]] ErrorAbout error_about(const signal::PreparedLoop& loop);

/// A loop's error for the comparison of all loops, in 16 bits a sample instead of 64, so that ten
/// thousand loops fit into memory: steps of a 65 534th of its range, whose noise is that of 16 bit
/// transmitters and below any share of the variance that is looked for.
class PackedError {
 public:
  PackedError() = default;
  /// `sample_interval_s` > 0, `start_us` of the first sample, microseconds UTC since 1970; NaN and
  /// infinity = missing.
  PackedError(std::span<const double> error, double sample_interval_s, std::int64_t start_us,
              ErrorAbout about = ErrorAbout::setpoint);

  [[nodiscard]] bool empty() const { return steps_.empty(); }
  [[nodiscard]] std::size_t size() const { return steps_.size(); }
  [[nodiscard]] std::size_t bytes() const { return steps_.size() * sizeof(steps_[0]); }
  [[nodiscard]] double sample_interval_s() const { return sample_interval_s_; }
  [[nodiscard]] std::int64_t start_us() const { return start_us_; }
  [[nodiscard]] ErrorAbout about() const { return about_; }
  /// pv units, within half a step; NaN = missing.
  [[nodiscard]] signal::Samples unpacked() const;
  /// make_envelope() of it.
  [[nodiscard]] Envelope envelope(double frequency_hz) const;

 private:
  double sample_interval_s_ = 1.0;
  std::int64_t start_us_ = 0;
  ErrorAbout about_ = ErrorAbout::setpoint;
  double middle_ = 0.0, step_ = 0.0;  // pv units
  std::vector<std::int16_t> steps_;   // from the middle
};

}  // namespace loopscope::core::plant
