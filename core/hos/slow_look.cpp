#include "core/hos/slow_look.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/hos/slow/decimate.hpp"
#include "core/hos/transforms/segments.hpp"

namespace loopscope::core::hos {
namespace {

/// Below this a Hann window cannot tell the fundamental from the mean: its main lobe is two bins
/// (two cycles a segment) wide to either side.
constexpr double kFewestCyclesPerSegment = 1.5;
/// Kept samples a cycle: the fourth harmonic lies at 1/3 cycles per kept sample, inside the
/// passband.
constexpr double kSamplesPerCycle = 12.0;
/// 2.4 to 3 cycles a segment: harmonics lie more than one main lobe's half width apart.
constexpr std::size_t kSegmentLength = 32;
/// The slow look has few samples; a Hann window leaves something to gain up to three quarters.
constexpr double kOverlap = 0.75;
/// With fewer segments an average says nothing (as for the first look).
constexpr std::size_t kFewestSlowSegments = 15;
/// Half the segments of a full window: the spread of the mean bicoherence is twice that of the
/// first look.
constexpr std::size_t kWantedSegments = 60;

std::size_t decimation_for(double period_samples) {
  return static_cast<std::size_t>(std::max(1.0, std::round(period_samples / kSamplesPerCycle)));
}

}  // namespace

bool needs_slow_look(double period_samples, const Settings& settings) {
  return std::isfinite(period_samples) &&
         kFewestCyclesPerSegment * period_samples > static_cast<double>(settings.segment_length);
}

std::size_t slow_span(double period_samples, const Settings& settings) {
  if (!needs_slow_look(period_samples, settings)) return 0;
  const std::size_t hop = segment_hop(slow_settings(settings));
  const std::size_t kept = kSegmentLength + (kWantedSegments - 1) * hop;
  return (kept + 2 * kDecimationHalfSupport) * decimation_for(period_samples);
}

Settings slow_settings(const Settings& settings) {
  Settings slow = settings;
  slow.segment_length = kSegmentLength;
  slow.dft_length = 2 * kSegmentLength;
  slow.overlap = kOverlap;
  return slow;
}

std::optional<SlowLook> look_slowly(std::span<const double> error, double period_samples,
                                    const Settings& settings, std::uint64_t seed,
                                    std::span<const double> tested) {
  validate(settings);
  if (!needs_slow_look(period_samples, settings)) return std::nullopt;
  const Settings slow = slow_settings(settings);
  const std::size_t decimation = decimation_for(period_samples);
  const std::vector<double> kept = decimate(error, decimation);
  if (segment_starts(kept, slow).size() < kFewestSlowSegments) return std::nullopt;
  std::optional<Result> result = tested.empty()
                                     ? analyse(kept, slow, seed)
                                     : analyse(kept, decimate(tested, decimation), slow, seed);
  if (!result) return std::nullopt;
  return SlowLook{decimation, error.size(), std::move(*result)};
}

}  // namespace loopscope::core::hos
