#pragma once

#include <optional>

#include "core/diagnosis/verdict.hpp"

namespace loopscope::core::diagnosis {

/// The share of each cause in the fit, 0 to 1: what is expected before anything is measured.
[[nodiscard]] const PerCause& shares_of_causes();

/// One window of a loop as it was judged, and as it is stored.
struct JudgedWindow {
  double start_s = 0.0;  ///< of its samples, on any clock; start < end
  double end_s = 0.0;
  bool with_model = false;  ///< whether a model was fitted to it
  PerCause probabilities;   ///< of that window alone
};

/// What the windows of a loop up to one of them say together.
struct CombinedOdds {
  double end_s = 0.0;
  double windows = 0.0;  ///< as many windows that share no sample would weigh as much, > 0
  PerCause probabilities;
};

/// The window beside those before it:
///
///     weight w    = share of its samples that are new * (1, or kWithoutModel)
///     n           = sum of w exp(-age / kMemoryWindows), age in lengths of the window
///     mean m      = weighted mean of the windows' log odds beyond the prior
///     log odds    = prior + m n / (1 + (n - 1) correlation)        (n < 1: prior + m)
///
/// Windows of one loop are wrong together, because their loop is of one kind: the correlation of
/// each cause is fitted (tests/verdict/windows), so that n windows count as many independent ones
/// as they are worth (Kish's design effect). n and the log odds of the window before are all that
/// has to be kept, so that the result follows from stored rows. Without `before` it is the window
/// alone. `priors`: of the settings the windows were judged with; missing ones are
/// shares_of_causes().
/// `before` ends before the window ends (std::invalid_argument).
[[nodiscard]] CombinedOdds combine(const std::optional<CombinedOdds>& before,
                                   const JudgedWindow& window, const PerCause& priors);

/// Log odds of a probability, which is kept a millionth away from 0 and 1.
[[nodiscard]] double log_odds_of(double probability);

/// What is older counts for nothing, in lengths of the window.
[[nodiscard]] double longest_memory_windows();

}  // namespace loopscope::core::diagnosis
