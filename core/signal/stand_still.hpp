#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/signal/flat_run.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// pv that stands still although it should move: a dead transmitter, or a dead line to the
/// archive.
struct StandStill {
  FlatRun run;              ///< of pv as recorded
  bool to_the_end = false;  ///< of the window
  bool whole = false;       ///< from the first recorded sample to the last
  /// In automatic the error stays beyond one step of pv on one side; where op is at an end of its
  /// range meanwhile, on one side.
  bool error_lasts = false;
  bool op_moves = false;  ///< beyond its noise
  double op_low = 0.0;    ///< smallest and largest op meanwhile, % (or op units); 0 = not recorded
  double op_high = 0.0;
  double error = 0.0;  ///< median of sp - pv meanwhile, pv units; 0 = no setpoint
};

/// What is asked; series are empty (not recorded) or as long as `pv`.
struct RecordedLoop {
  std::span<const double> pv = {};  ///< as recorded: nothing bridged, nothing discarded
  std::span<const double> sp = {};
  std::span<const double> op = {};  ///< % of its range, or op units
  bool op_in_percent = false;
  std::span<const ControlMode> mode = {};
  std::optional<PvPast> past = std::nullopt;  ///< of pv before the window
  double sample_interval_s = 1.0;
};

/// The latest run of equal values of pv that is 300 samples long and ten times as long as what is
/// usual for this loop (before the window, or within it; not in manual), while op moves by more
/// than its noise and half a percent, or the controller is in automatic and the error stays beyond
/// one step of pv; what follows a move of the setpoint in its last 300 samples is not asked, since
/// pv answers behind its dead time. nullopt = pv does not stand still, or may do so (manual, no
/// error, a calm loop).
///
/// A run of healthy pv is as long as its grid, its dead band and its calm make it; those of one
/// loop are alike. So the first that is ten times longer is something else.
[[nodiscard]] std::optional<StandStill> find_stand_still(const RecordedLoop& loop);

/// What a window tells those after it: the longest run of pv and its usual smallest step, with what
/// was known before (of the run 0.5 % less). Nothing is learnt of runs in manual, of those that are
/// unusually long within the window, and of those that one of its ends cuts: they may be part of
/// one.
[[nodiscard]] PvPast past_with(const RecordedLoop& loop);

}  // namespace loopscope::core::signal
