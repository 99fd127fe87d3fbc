#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/hos/analyse.hpp"
#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos {

/// The statistics of a signal resampled to about twelve samples a cycle of a slow oscillation.
struct SlowLook {
  std::size_t decimation = 1;  ///< raw samples per kept sample
  std::size_t samples = 0;     ///< raw samples of the span that was looked at
  Result result;               ///< its peaks in cycles per kept sample
};

/// Whether a segment holds fewer than 1.5 cycles of an oscillation of this period (in samples), so
/// that fundamental, harmonics and mean fall into the same few bins.
[[nodiscard]] bool needs_slow_look(double period_samples, const Settings& settings);

/// Raw samples that give the slow look 60 segments: about 44 cycles; 0 when none is needed.
[[nodiscard]] std::size_t slow_span(double period_samples, const Settings& settings);

/// The settings of the slow look: segments of 32 kept samples (2.4 to 3 cycles) every 8, DFT of 64;
/// everything else as given.
[[nodiscard]] Settings slow_settings(const Settings& settings);

/// The second look: decimate() to 10.6 to 13.5 samples a cycle, then analyse() with
/// slow_settings().
///
/// `error` may hold NaN for missing samples. Returns nullopt when no slow look is needed, when gaps
/// and length leave fewer than 15 segments (about 14 cycles), and when analyse() has no result.
/// `seed` as for analyse(), and `tested`, empty for `error` itself. Throws std::invalid_argument
/// for settings out of range.
[[nodiscard]] std::optional<SlowLook> look_slowly(std::span<const double> error,
                                                  double period_samples, const Settings& settings,
                                                  std::uint64_t seed = 0,
                                                  std::span<const double> tested = {});

}  // namespace loopscope::core::hos
