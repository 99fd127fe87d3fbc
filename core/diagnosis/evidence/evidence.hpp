#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/hos/analyse.hpp"
#include "core/hos/slow_look.hpp"
#include "core/loop/op_at_ends.hpp"
#include "core/loop/oscillation.hpp"
#include "core/loop/performance.hpp"
#include "core/loop/pv_plateaus.hpp"
#include "core/loop/shape.hpp"
#include "core/loop/unit_match.hpp"
#include "core/loop/valve_gain.hpp"
#include "core/model/limit_cycle/limit_cycle_cause.hpp"
#include "core/model/limit_cycle/slow_travel.hpp"
#include "core/model/results/explanation.hpp"
#include "core/signal/control_state.hpp"
#include "core/signal/prepared_loop.hpp"
#include "core/signal/stand_still.hpp"

namespace loopscope::core {

/// What the p-values of the higher-order statistics rest on; the published indices are always those
/// of sp - pv.
enum class TestedOn {
  error,           ///< sp - pv
  model_residual,  ///< sp - pv less the loop's linear answer to a setpoint that moves all the time
};
[[nodiscard]] std::string_view name(TestedOn tested_on);

/// Everything measured on one window; what could not be measured is nullopt in its own struct.
struct Evidence {
  signal::DataQuality data_quality;
  std::optional<hos::Result> hos;  ///< nullopt when the data are not usable
  TestedOn tested_on = TestedOn::error;
  std::size_t samples_wanted = 0;  ///< with which Coupling::too_short would not be; 0 = it is not
  loop::Oscillation oscillation;   ///< of the error
  loop::Performance performance;
  loop::Shape shape;
  loop::ValveGain valve_gain;
  bool integrating = false;    ///< level loop: the vessel integrates (from the catalogue)
  bool op_in_percent = false;  ///< by a range that was set or inferred
  bool op_range_set = false;   ///< by a person: sizes in percent, and its ends, can be relied on
  std::string op_range_doubt;  ///< why a range that was set cannot be right; empty = it can
  double interval_s = 1.0;
  std::size_t samples = 0;                  ///< of the window
  std::optional<signal::StandStill> still;  ///< pv stands still although it should not
  signal::PvPast pv_past;                   ///< what this window and those before tell the next
  signal::ControlState control;             ///< whether a controller acts
  /// The loop's cycle, if it has one, and whether a valve that sticks would make it; nullopt where
  /// pv or op cannot be judged. Its figures are filled below five cycles, too.
  std::optional<model::CycleCause> cycle;
  std::optional<model::SlowTravel> travel;  ///< whether pv follows op's slow travel
  /// The same on means over a slow cycle's hundred-and-twenty-eighths; nullopt where the cycle is
  /// faster or there is none.
  std::optional<model::SlowTravel> cycle_travel;
  std::optional<loop::PvPlateaus> pv_plateaus;  ///< of pv while op travels, in that cycle
  /// Whether setpoint and pv are in different units; nullopt where no setpoint is recorded.
  std::optional<loop::UnitMatch> units;
  std::optional<loop::OpAtEnds> op_at_ends;  ///< at the ends of what op covers
  /// The same statistics on data resampled to fit a slow oscillation; nullopt when none is needed
  /// or too little is recorded.
  std::optional<hos::SlowLook> hos_slow;
  /// Samples up to the window's end that the slow look wants; 0 = the window is long enough, or no
  /// slow look is needed.
  std::size_t slow_span_samples = 0;
  /// The fitted loop model's story; nullopt = switched off, no op, or data not usable.
  std::optional<model::Explanation> model;
};

}  // namespace loopscope::core
