#include "core/diagnosis/combined_odds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>

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

/// By name in the table, so that no order can go wrong.
const PerCause& correlations() {
  static const PerCause all = [] {
    PerCause result;
    for (const auto& [cause, correlation] : kWindowCorrelation)
      set_cause(result, verdict_code(cause).value(), correlation);
    return result;
  }();
  return all;
}

/// How many windows without correlation n correlated ones are worth.
double worth(double windows, std::size_t cause) {
  if (windows <= 1.0) return 1.0;
  return windows / (1.0 + (windows - 1.0) * correlations().at(cause).value());
}

std::optional<double> at(const PerCause& values, std::size_t cause) {
  return cause < values.size() ? values[cause] : std::nullopt;
}

/// Mean and n of one cause.
struct Weighed {
  double mean = 0.0;
  double windows = 0.0;
};

/// `fading`: what time has left of it, 0 to 1.
std::optional<Weighed> next(const std::optional<Weighed>& before, double fading,
                            const std::optional<double>& added, double weight) {
  if (!before && !added) return std::nullopt;
  const Weighed known = before.value_or(Weighed{});
  const double kept = known.windows * fading;
  if (!added) return Weighed{known.mean * fading, kept};
  return Weighed{(kept * known.mean + weight * *added) / (kept + weight), kept + weight};
}

std::optional<Weighed> weighed_before(const std::optional<CombinedOdds>& before,
                                      std::size_t cause) {
  if (!before) return std::nullopt;
  const std::optional<double> mean = at(before->evidence, cause);
  const std::optional<double> windows = at(before->windows, cause);
  if (!mean || !windows) return std::nullopt;
  return Weighed{*mean, *windows};
}

}  // namespace

const PerCause& shares_of_causes() {
  static const PerCause shares = [] {
    PerCause result;
    for (const CauseCurves& curves : fitted_curves(true))
      set_cause(result, verdict_code(curves.cause).value(), curves.share);
    return result;
  }();
  return shares;
}

PerCause evidence_of(const Verdict& verdict) {
  PerCause evidence = probabilities_of(verdict);
  const PerCause priors = priors_of(verdict);
  for (std::size_t cause = 0; cause < evidence.size(); ++cause)
    if (evidence[cause])
      evidence[cause] = log_odds_of(*evidence[cause]) - log_odds_of(*priors[cause]);
  return evidence;
}

CombinedOdds combine(const std::optional<CombinedOdds>& before, const JudgedWindow& window) {
  const double length = window.end_s - window.start_s;
  if (!(length > 0.0) || (before && before->end_s >= window.end_s))
    throw std::invalid_argument("combine: windows are given by ascending ends, each with a length");
  const double age = before ? (window.end_s - before->end_s) / length : kLongestMemory;
  const double fading = age < kLongestMemory ? std::exp(-age / kMemoryWindows) : 0.0;
  const double weight = std::min(1.0, age) * (window.with_model ? 1.0 : kWithoutModel);
  const std::size_t causes = std::max(window.evidence.size(), before ? before->evidence.size() : 0);
  CombinedOdds result{window.end_s, PerCause(causes), PerCause(causes)};
  for (std::size_t cause = 0; cause < causes; ++cause) {
    const auto weighed =
        next(weighed_before(before, cause), fading, at(window.evidence, cause), weight);
    if (!weighed) continue;
    result.evidence[cause] = weighed->mean;
    result.windows[cause] = weighed->windows;
  }
  return result;
}

PerCause probabilities_of(const CombinedOdds& combined, const PerCause& priors) {
  PerCause result(combined.evidence.size());
  for (std::size_t cause = 0; cause < result.size(); ++cause) {
    const std::optional<double> mean = combined.evidence[cause];
    if (!mean) continue;
    const double prior = at(priors, cause).value_or(at(shares_of_causes(), cause).value_or(0.5));
    const double odds =
        log_odds_of(prior) + *mean * worth(at(combined.windows, cause).value_or(0.0), cause);
    result[cause] = 1.0 / (1.0 + std::exp(-odds));
  }
  return result;
}

double most_windows(const CombinedOdds& combined) {
  double most = 0.0;
  for (const std::optional<double>& windows : combined.windows)
    most = std::max(most, windows.value_or(0.0));
  return most;
}

double log_odds_of(double probability) {
  // What is surer than a million to one is as sure as a model of a plant can be.
  constexpr double kLeast = 1e-6;
  const double p = std::clamp(probability, kLeast, 1.0 - kLeast);
  return std::log(p / (1.0 - p));
}

double longest_memory_windows() {
  return kLongestMemory;
}

}  // namespace loopscope::core::diagnosis
