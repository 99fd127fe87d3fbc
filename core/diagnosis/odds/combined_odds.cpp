#include "core/diagnosis/odds/combined_odds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnosis/odds/cause_curves.hpp"
#include "core/diagnosis/odds/explaining_away.hpp"
#include "core/diagnosis/odds/log_odds.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::core::diagnosis {
namespace {

#include "core/diagnosis/odds/several_windows.inc"

/// A fault that begins, and a repair, show as soon as one window holds them. Longer memories make
/// the odds no better: windows of one loop err together, and their mean is all that they add
/// (MEASURED.md, "Several windows of a loop").
constexpr double kMemoryWindows = 1.25;
/// exp(-6) of a window's weight is a four-hundredth.
constexpr double kLongestMemory = 6.0 * kMemoryWindows;
/// Of a cause that the fit does not know.
constexpr double kEven = 0.5;

std::optional<double> at(const PerCause& values, std::size_t cause) {
  return cause < values.size() ? values[cause] : std::nullopt;
}

std::optional<double> at(const PerCause& values, VerdictCode cause) {
  return at(values, static_cast<std::size_t>(cause));
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

/// Of what was known before, in lengths of the window.
double age_of(const std::optional<CombinedOdds>& before, const JudgedWindow& window) {
  if (!before) return kLongestMemory;
  return (window.end_s - before->end_s) / (window.end_s - window.start_s);
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

const std::map<VerdictCode, SeveralWindows>& fitted_windows() {
  static const std::map<VerdictCode, SeveralWindows> by_cause = [] {
    std::map<VerdictCode, SeveralWindows> result;
    for (SeveralWindows& row : several_windows())
      result.emplace(verdict_code(row.cause).value(), std::move(row));
    return result;
  }();
  return by_cause;
}

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
  PerCause evidence;
  if (verdict.stands_alone) return evidence;
  for (const CauseReport& cause : verdict.causes) {
    const double prior = log_odds_of(at(shares_of_causes(), cause.code).value_or(cause.prior));
    set_cause(evidence, cause.code, log_odds_of(probability_of(prior + cause.evidence)) - prior);
  }
  return evidence;
}

bool stands_alone(const std::optional<CombinedOdds>& before, const JudgedWindow& window) {
  return age_of(before, window) >= kLongestMemory;
}

CombinedOdds combine(const std::optional<CombinedOdds>& before, const JudgedWindow& window) {
  const double age = age_of(before, window);
  if (!(window.end_s > window.start_s) || !(age > 0.0))
    throw std::invalid_argument("combine: windows are given by ascending ends, each with a length");
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
  std::vector<OwnOdds> all;
  std::vector<double> shifts;
  for (const auto& [code, fitted] : fitted_windows()) {
    const double share = at(shares_of_causes(), code).value_or(kEven);
    // One that was not weighed is as probable as anywhere, and as much of a rival.
    const double evidence = at(combined.evidence, code).value_or(0.0);
    shifts.push_back(log_odds_of(at(priors, code).value_or(share)) - log_odds_of(share));
    all.push_back({code, log_odds_of(share) + evidence + shifts.back(), &fitted.beside});
  }
  PerCause result(combined.evidence.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!at(combined.evidence, all[k].code)) continue;
    const double by_fit = explaining_away(all[k].log_odds - shifts[k], k, all);
    set_cause(result, all[k].code, probability_of(shifts[k] + by_fit));
  }
  return result;
}

double most_windows(const CombinedOdds& combined) {
  double most = 0.0;
  for (const std::optional<double>& windows : combined.windows)
    most = std::max(most, windows.value_or(0.0));
  return most;
}

double longest_memory_windows() {
  return kLongestMemory;
}

}  // namespace loopscope::core::diagnosis
