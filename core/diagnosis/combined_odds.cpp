#include "core/diagnosis/combined_odds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "core/diagnosis/cause_curves.hpp"
#include "core/diagnosis/verdict.hpp"

namespace loopscope::core::diagnosis {
namespace {

#include "core/diagnosis/window_correlation.inc"

/// A repair shows in the combined odds after a day or two of windows of some hours, and n of
/// several windows is enough: their correlation leaves little to be won by more.
constexpr double kMemoryWindows = 4.0;
/// exp(-6) of a window's weight is a four-hundredth.
constexpr double kLongestMemory = 6.0 * kMemoryWindows;
/// How many windows without correlation n correlated ones are worth.
double worth(double windows, std::size_t cause) {
  if (windows <= 1.0) return 1.0;
  return windows / (1.0 + (windows - 1.0) * kWindowCorrelation.at(cause));
}

/// A cause that this window says nothing of was weighed by windows before.
double expected(std::size_t cause, const PerCause& priors) {
  if (cause < priors.size() && priors[cause]) return *priors[cause];
  const PerCause& shares = shares_of_causes();
  return cause < shares.size() ? shares[cause].value_or(0.5) : 0.5;
}

/// Mean log odds beyond the prior.
std::optional<double> mean_of(const CombinedOdds& combined, std::size_t cause, double prior) {
  if (cause >= combined.probabilities.size() || !combined.probabilities[cause]) return std::nullopt;
  return (log_odds_of(*combined.probabilities[cause]) - prior) / worth(combined.windows, cause);
}

/// The mean with one more window; what was not weighed changes nothing.
std::optional<double> next_mean(std::optional<double> before, double kept,
                                std::optional<double> added, double weight) {
  if (!before) return added;
  if (!added) return before;
  return (kept * *before + weight * *added) / (kept + weight);
}

}  // namespace

const PerCause& shares_of_causes() {
  static const PerCause shares = [] {
    PerCause result;
    for (const CauseCurves& curves : fitted_curves(true)) {
      const auto place = static_cast<std::size_t>(verdict_code(curves.cause).value());
      if (place >= result.size()) result.resize(place + 1);
      result[place] = curves.share;
    }
    return result;
  }();
  return shares;
}

CombinedOdds combine(const std::optional<CombinedOdds>& before, const JudgedWindow& window,
                     const PerCause& priors) {
  const double length = window.end_s - window.start_s;
  if (!(length > 0.0) || (before && before->end_s >= window.end_s))
    throw std::invalid_argument("combine: windows are given by ascending ends, each with a length");
  const double age = before ? (window.end_s - before->end_s) / length : kLongestMemory;
  const double kept =
      before && age < kLongestMemory ? before->windows * std::exp(-age / kMemoryWindows) : 0.0;
  const double weight = std::min(1.0, age) * (window.with_model ? 1.0 : kWithoutModel);
  const std::size_t causes =
      std::max(window.probabilities.size(), before ? before->probabilities.size() : 0);
  CombinedOdds result{window.end_s, kept + weight, PerCause(causes)};
  for (std::size_t cause = 0; cause < causes; ++cause) {
    const double prior = log_odds_of(expected(cause, priors));
    std::optional<double> own;
    if (cause < window.probabilities.size() && window.probabilities[cause])
      own = log_odds_of(*window.probabilities[cause]) - prior;
    const auto mean =
        next_mean(kept > 0.0 ? mean_of(*before, cause, prior) : std::nullopt, kept, own, weight);
    if (!mean) continue;
    const double odds = prior + *mean * worth(result.windows, cause);
    result.probabilities[cause] = 1.0 / (1.0 + std::exp(-odds));
  }
  return result;
}

double log_odds_of(double probability) {
  // Odds that are stored in four bytes keep six digits of a probability.
  constexpr double kLeast = 1e-6;
  const double p = std::clamp(probability, kLeast, 1.0 - kLeast);
  return std::log(p / (1.0 - p));
}

double longest_memory_windows() {
  return kLongestMemory;
}

}  // namespace loopscope::core::diagnosis
