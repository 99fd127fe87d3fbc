#pragma once

#include <optional>

#include "core/diagnosis/odds/combined_odds.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::storage {

/// As arrays of real hold them: four bytes each, nothing smaller than what these show exactly, and
/// nothing that is not finite. The next slot begins with what is stored, whether it is reached in
/// this transaction or in another.
[[nodiscard]] core::diagnosis::PerCause as_stored(core::diagnosis::PerCause values);

/// What the windows up to a slot say, as stored.
struct Combined {
  core::diagnosis::CombinedOdds odds;
  core::diagnosis::PerCause probabilities;
};

/// The windows of one loop in their order, combined (core/diagnosis/odds/combined_odds).
class LoopWindows {
 public:
  void begin_with(Combined before) { combined_ = std::move(before); }

  /// Empty where the window could not be judged; as before where it holds nothing new. The window
  /// is as stored, `probabilities` are those that it was judged with, `priors` those of the
  /// probabilities that stand beside several windows.
  Combined next(const core::diagnosis::JudgedWindow& window,
                const core::diagnosis::PerCause& probabilities,
                const core::diagnosis::PerCause& priors);

 private:
  std::optional<Combined> combined_;
};

}  // namespace loopscope::storage
