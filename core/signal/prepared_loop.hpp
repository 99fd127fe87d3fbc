#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/signal/archive.hpp"
#include "core/signal/control_state.hpp"
#include "core/signal/loop_window.hpp"
#include "core/signal/op_range.hpp"
#include "core/signal/stand_still.hpp"

namespace loopscope::core::signal {

/// Whether a window can be judged, and what is odd about it.
struct DataQuality {
  bool usable = false;                ///< for the statistics
  bool enough = false;                ///< long enough, and enough of it recorded
  std::string reason;                 ///< why not usable, in plain words; empty when it is
  std::vector<std::string> flags;     ///< e.g. "short", "sp_missing", "op_range_unknown"
  std::vector<std::string> refusals;  ///< why tests are refused, in plain words
  std::string stretch;  ///< samples that the higher-order statistics see where the record is not
                        ///< stationary, in plain words; empty = all
  std::size_t repeated_times = 0;            ///< rows dropped because a later row had the same time
  std::optional<double> missing_fraction;    ///< of the pv samples, 0 to 1
  std::optional<double> frozen_fraction;     ///< of the pv samples, standing still, 0 to 1
  std::optional<double> drawn_fraction;      ///< of the pv samples, not stored but drawn, 0 to 1
  Archive archive = Archive::complete;       ///< how pv was stored
  std::optional<double> compression_factor;  ///< samples per stored or new value, gaps out, >= 1
  std::optional<double> quantisation_factor;  ///< grid step of pv / its standard deviation
  std::optional<double> saturated_fraction;   ///< of op at a limit of its range, 0 to 1
};

/// Limits of what can be judged.
struct PrepareSettings {
  std::size_t window_samples = 4096;     ///< the last so many samples are analysed
  std::size_t min_usable_samples = 512;  ///< 15 segments of 64 at 50 % overlap
  double max_missing_fraction = 0.4;     ///< 0 to 1; more than this and the window is not judged
  std::size_t max_filled_gap = 2;        ///< missing samples in a row that a line may bridge
  std::size_t slow_span_windows = 4;     ///< the slow look may ask for so many windows, >= 1
};

/// A window made ready for the numerics: the error signal, op in percent, and what was found odd.
struct PreparedLoop {
  double sample_interval_s = 1.0;
  /// sp - pv (mean(pv) - pv without sp), pv units; NaN = missing, or manual unless most samples
  /// are.
  Samples error;
  Samples sp;          ///< gaps of up to max_filled_gap held, else NaN; empty = not recorded
  Samples pv;          ///< spikes and gaps of up to max_filled_gap bridged, else NaN
  Samples op_percent;  ///< % of range; op units without one; empty = no op
  Samples mv_percent;  ///< likewise
  /// What the higher-order statistics start from: the error with a guess in every sample that may
  /// be drawn, and the bounds of these, pv units (NaN = nothing to draw there); all three empty =
  /// nothing is to be drawn: `error` as it is.
  struct Drawable {
    Samples error, low, high;
  };
  Drawable drawable;
  Archive archive = Archive::complete;
  double band = 0.0;          ///< of the archive, pv units, half width; 0 = none
  std::size_t pv_stored = 0;  ///< pv samples that the archive stored; see Archive
  std::size_t pv_gaps = 0;    ///< pv samples missing in gaps too long to draw
  std::vector<ControlMode> mode;
  std::optional<StandStill> still;  ///< pv stands still although it should not
  PvPast past;                      ///< of pv, this window included
  ControlState control;
  std::size_t pv_recorded = 0;     ///< pv samples before any gap was bridged
  std::size_t repeated_times = 0;  ///< rows dropped because a later row had the same time
  std::size_t spikes = 0;          ///< pv samples taken for outliers
  KnownRange op_range;
  [[nodiscard]] bool op_in_percent() const { return op_range.range.has_value(); }
  bool op_moves = false;  ///< op was recorded and is not constant
  DataQuality quality;
};

}  // namespace loopscope::core::signal
