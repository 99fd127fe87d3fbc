#pragma once

#include <cstddef>
#include <string_view>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// What became of the samples between those that were stored.
enum class Archive {
  complete,       ///< every sample was stored, gaps aside
  scattered,      ///< some are missing, and nothing is known of them
  on_change,      ///< a coarse value stored when it changes: it stayed as it was
  dead_band,      ///< stored when it left a band about the value stored last
  swinging_door,  ///< on the line between two stored ones, within a band
  rounded,        ///< every sample was stored, on a coarse grid of values
  coarser,        ///< renewed at a regular multiple of the interval: a slower sensor or scan
};

[[nodiscard]] std::string_view name(Archive archive);

/// pv as it was stored.
struct StoredSamples {
  Samples value;  ///< pv units; NaN = not stored, or missing
  Archive archive = Archive::complete;
  double band = 0.0;  ///< pv units, half width, of rounding where it is coarse; 0 = no band
};

/// A grid of values with steps above this share of pv's standard deviation shapes the statistics
/// (README, "Samples that were not stored"; Thornhill, Choudhury and Shah 2004).
inline constexpr double kCoarseGrid = 0.4;

/// Samples in a row that were not stored, this many at most, are a hole, which may be drawn; more
/// are a gap, which stays missing. Half a segment of 64 where a band bounds the samples, a quarter
/// where nothing is known of them.
inline constexpr std::size_t kLongestBandedHole = 32;
inline constexpr std::size_t kLongestHole = 16;

/// Finds the samples that were stored, and how the archive chose them, from the values alone.
///
/// `pv` on a uniform grid, NaN where nothing was recorded or no row lies; what was put between the
/// rows shows as repeated values (steps) or as samples on a straight line. `rows` says instead
/// which samples are rows, where that is known (NaN elsewhere); empty = not known.
///
/// A dead band leaves no two successive stored values closer than itself, a swinging door no three
/// stored in a row closer to a line than twice its width: a sharp lower edge of their distances,
/// which nothing else has. A grid of values (quantisation) repeats values too: repeats count only
/// where there are more than the grid explains; and a value at which pv is clipped is a value.
[[nodiscard]] StoredSamples find_stored(const Samples& pv, const Samples& rows = {});

}  // namespace loopscope::core::signal
