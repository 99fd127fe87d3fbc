#pragma once

#include <cstddef>

namespace loopscope::daemon {

/// A share of trials and what it says of the probability behind it.
struct BinomialShare {
  double share = 0.0;  ///< successes / trials
  double low = 0.0;    ///< Clopper-Pearson limits: they hold the probability in at least 95 % of
  double high = 1.0;   ///< samples, whatever it is
};

/// `successes` of `trials`; throws std::invalid_argument unless 0 < trials and successes <= trials.
[[nodiscard]] BinomialShare binomial_share(std::size_t successes, std::size_t trials);

}  // namespace loopscope::daemon
