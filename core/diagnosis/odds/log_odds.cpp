#include "core/diagnosis/odds/log_odds.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::diagnosis {

double log_odds_of(double probability) {
  // What is surer than a million to one is as sure as a model of a plant can be.
  constexpr double kLeast = 1e-6;
  const double p = std::clamp(probability, kLeast, 1.0 - kLeast);
  return std::log(p / (1.0 - p));
}

double probability_of(double log_odds) {
  return 1.0 / (1.0 + std::exp(-log_odds));
}

}  // namespace loopscope::core::diagnosis
