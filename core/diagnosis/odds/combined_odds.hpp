#pragma once

#include <map>
#include <optional>
#include <string_view>

#include "core/diagnosis/odds/explaining_away.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::core::diagnosis {

/// What a cause is beside the others, after several windows.
struct SeveralWindows {
  std::string_view cause;  ///< code of the verdict
  ExplainingAway beside;
};

/// The fitted table (several_windows.inc, written by tests/verdict/windows), of every cause that
/// has curves.
[[nodiscard]] const std::map<VerdictCode, SeveralWindows>& fitted_windows();

/// The share of each cause in the fit, 0 to 1: what is expected before anything is measured.
[[nodiscard]] const PerCause& shares_of_causes();

/// What one window says of each cause by the cause's own figures: log odds beyond the prior, so far
/// that no probability is nearer than a millionth to 0 and 1. Whatever the priors and the others.
/// Empty where the verdict stands alone.
[[nodiscard]] PerCause evidence_of(const Verdict& verdict);

/// One window of a loop as it was judged, and as it is stored.
struct JudgedWindow {
  double start_s = 0.0;  ///< of its samples, on any clock; start < end
  double end_s = 0.0;
  bool with_model = false;  ///< whether a model was fitted to it
  PerCause evidence;        ///< of that window alone
};

/// What the windows of a loop up to one of them say together, of each cause.
struct CombinedOdds {
  double end_s = 0.0;
  PerCause evidence;  ///< weighted mean of the windows' log odds beyond the prior
  PerCause windows;   ///< as many windows that share no sample would weigh as much
};

/// The window beside those before it:
///
///     weight w    = share of its samples that are new * (1, or kWithoutModel)
///     n           = sum of w exp(-age / kMemoryWindows), age in lengths of the window
///     mean m      = weighted mean of the windows' log odds beyond the prior
///     log odds    = prior + m
///     then beside the others (explaining_away.hpp), once, after all windows
///
/// Windows of one loop are wrong together, because their loop is of one kind: more of them make
/// nobody surer of a cause than one does, and their mean is what they are worth. Mean and n of the
/// window before are all that has to be kept, so that the result follows from stored rows, whatever
/// the priors become. Of a cause that the window does not weigh (op stands still) what was known
/// fades with its age.
/// Throws std::invalid_argument unless `before` ends before the window does, and the window has a
/// length.
[[nodiscard]] CombinedOdds combine(const std::optional<CombinedOdds>& before,
                                   const JudgedWindow& window);

/// Whether nothing before the window counts (any more): then what the window itself says stands.
[[nodiscard]] bool stands_alone(const std::optional<CombinedOdds>& before,
                                const JudgedWindow& window);

/// With these priors (0 to 1); missing ones are shares_of_causes(). nullopt for a cause that no
/// window weighed. What stands beside the others is fitted to several windows, with and without a
/// model: of one that stands alone it is not quite its own.
[[nodiscard]] PerCause probabilities_of(const CombinedOdds& combined, const PerCause& priors);

/// The largest n of all causes, in windows; 0 = nothing was weighed.
[[nodiscard]] double most_windows(const CombinedOdds& combined);

/// What is older counts for nothing, in lengths of the window.
[[nodiscard]] double longest_memory_windows();

}  // namespace loopscope::core::diagnosis
