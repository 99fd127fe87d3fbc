#pragma once

namespace loopscope::core::diagnosis {

/// Log odds of a probability, which is kept a millionth away from 0 and 1.
[[nodiscard]] double log_odds_of(double probability);
[[nodiscard]] double probability_of(double log_odds);

}  // namespace loopscope::core::diagnosis
