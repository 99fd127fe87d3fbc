#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/model/record/loop_data.hpp"
#include "core/model/results/mechanism.hpp"

namespace loopscope::core::model {

/// What a recording says about the valve when nothing but sp, pv and op is known: errors of a
/// simulation of pv from op in the band of the loop's cycle, and the shape of the cycle.
/// Errors are shares of pv's variance in that band. Means over the parts of a long record.
struct CycleEvidence {
  double cycles = 0.0;  ///< in the record
  double period_samples = 0.0;
  double error_before = 1.0;   ///< linear, held out
  double error_law = 1.0;      ///< behind a valve of He's law, held out
  double error_turning = 1.0;  ///< behind a valve known to have moved at every turn of op, held out
  double part_ratio = 1.0;     ///< median over blocks of two cycles of turning / linear error
  double steadiness = 0.0;     ///< share of blocks in which the valve lowers the error
  double band_share = 0.0;     ///< S of the law over op's peak-to-peak travel in the band
  double travel = 0.0;  ///< peak-to-peak travel of op in the band were it a triangle, op units
  double op_coherence = 0.0;  ///< share of op that its mean half cycle explains
  double op_triangle = 0.0;   ///< - third harmonic of op: 1/9 triangle, 0 sine, -1/3 square
  double pv_third = 0.0;      ///< third harmonic of pv: 1/3 square
  double pv_triangle = 0.5;   ///< He's index of pv, 0 sine, 1 triangle
  double stickband = 0.0;     ///< S, op units
  double slip_jump = 0.0;     ///< J, op units
  double delay_samples = 0.0;
  double lag_samples = 0.0;    ///< infinite: integrating within the band
  std::optional<double> pace;  ///< of the error's half cycles by their size (cycle_pace.hpp)
  double gain = 0.0;  ///< pv units per op unit behind the lag (integrating: and kept sample)
  bool integrating = false;

  /// By how much of a quarter of the cycle pv lags behind the flow, the dead time left out: 0 where
  /// it follows at once, 1 behind an integrator.
  [[nodiscard]] double process_lag() const;
};

struct CycleCause {
  enum class Decision { undecided, sticks, does_not_stick };
  Decision decision = Decision::undecided;
  double score = 0.0;  ///< 0 to 1; sticks from 0.5 on
  CycleEvidence evidence;
  std::string reason;
};

/// Whether a sticking valve makes the loop cycle. pv, op, sp of equal length on an even grid, NaN =
/// missing; sp empty or all missing: its mean level is taken to be constant. Undecided when pv or
/// op is missing in more than 40 % of the samples or stands still, or fewer than 128 samples or
/// five cycles are recorded. Throws std::invalid_argument for unequal lengths. MEASURED.md has the
/// rates.
[[nodiscard]] CycleCause judge_limit_cycle(std::span<const double> pv, std::span<const double> op,
                                           std::span<const double> sp, const Without& without = {});

/// The same of what a model is given, which may have been judged before.
[[nodiscard]] CycleCause cycle_of(const ModelInput& input);

/// Whether the setpoint moves enough to drive the loop: a tenth of pv's standard deviation.
[[nodiscard]] bool setpoint_moves(const ModelInput& input);

/// Whether op cycles no more often than such a setpoint turns: then its moves make the cycle, and
/// its shape is theirs. A loop that cycles by itself turns more often.
[[nodiscard]] bool driven_by_setpoint(const ModelInput& input, const CycleEvidence& cycle);

}  // namespace loopscope::core::model
