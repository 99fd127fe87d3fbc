#pragma once

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/odds/cause_odds.hpp"
#include "core/diagnosis/odds/combined_odds.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::diagnosis {

/// What decides beside the probabilities.
struct Circumstances {
  bool structured = false;   ///< something in the loop is clearly no noise (structure.hpp)
  bool sizes_known = false;  ///< the ranges of op and pv
  bool limit_seen = true;    ///< op at a limit, or at rest at an end of its travel
  /// A test of coupling, a residual test or a step of the model shows a nonlinearity.
  bool nonlinear_shown = true;
};

/// The code that the probabilities come to; see decide(). `causes`: the most probable first;
/// `line`: DecisionSettings::line.
[[nodiscard]] VerdictCode code_for(const Causes& causes, const Circumstances& circumstances,
                                   double line);

/// From evidence to verdict. Each cause has log odds, a sum of weights over figures
/// (cause_odds.hpp); the verdict is the most probable cause above the line:
///
///     a state that the data show (loop_state.hpp)     -> its verdict
///     no data to judge                                -> insufficient_data
///     setpoint not followed at all                    -> unexplained (not in command)
///     the most probable cause is above the line and at least as probable as healthy
///                                                     -> that cause
///     valve or process nonlinear, any of them: likewise, a probability of 0.5 at least, and shown
///                                                     -> nonlinear_unexplained
///     healthy below the line, and something is clearly no noise (structure.hpp)
///                                                     -> unexplained
///     else                                            -> healthy
///
/// Where op is not recorded or stands still, causes in valve and controller are not weighed. Of
/// `healthy` below the line confidence says how little is known.
///
/// Confidence is the probability of what is said; of `unexplained` 1 less the largest probability
/// of all others. `valve_oversized` is named only where the ranges of op and pv are known, since it
/// compares the two, `valve_saturation` only where op is seen at a limit. Never throws.
///
/// `combined`: of this window and those before it; the verdict is then that of all of them, with
/// the figures of this one. nullptr = this window alone.
[[nodiscard]] Verdict decide(const Evidence& evidence, const hos::Settings& settings,
                             const DecisionSettings& decision = {},
                             const CombinedOdds* combined = nullptr);

}  // namespace loopscope::core::diagnosis
