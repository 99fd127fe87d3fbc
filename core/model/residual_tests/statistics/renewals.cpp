#include "core/model/residual_tests/statistics/renewals.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "core/hos/numeric/distributions.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kOnClock = 0.98;
constexpr std::size_t kFewestRuns = 5;
constexpr std::size_t kMostLengths = 8;

/// The most common lengths of runs and their common divisors.
std::set<std::size_t> candidates_of(std::span<const FlatRun> runs) {
  std::map<std::size_t, std::size_t> counts;
  for (const FlatRun& run : runs) ++counts[run.samples];
  std::vector<std::pair<std::size_t, std::size_t>> common;  // count, length
  common.reserve(counts.size());
  for (const auto& [length, count] : counts) common.emplace_back(count, length);
  std::sort(common.rbegin(), common.rend());
  common.resize(std::min(common.size(), kMostLengths));
  std::set<std::size_t> candidates;
  for (const auto& first : common)
    for (const auto& second : common) candidates.insert(std::gcd(first.second, second.second));
  candidates.erase(1);
  return candidates;
}

std::size_t most_at_one_phase(std::span<const FlatRun> runs, std::size_t period) {
  std::vector<std::size_t> counts(period);
  for (const FlatRun& run : runs) ++counts[run.begin % period];
  return *std::max_element(counts.begin(), counts.end());
}

/// Chernoff's bound for at least `hits` of `tries` at probability 1 / period, for any phase.
double chance(double hits, double tries, double period) {
  const double share = hits / tries;
  double exponent = share * std::log(share * period);
  if (share < 1.0) exponent += (1.0 - share) * std::log((1.0 - share) / (1.0 - 1.0 / period));
  return period * std::exp(-tries * exponent);
}

}  // namespace

std::vector<FlatRun> complete_runs(std::span<const double> signal, double tolerance) {
  std::vector<FlatRun> runs;
  std::size_t begin = 0;  // 0 = unknown
  for (std::size_t k = 1; k < signal.size(); ++k) {
    if (std::isnan(signal[k]) || std::isnan(signal[k - 1])) {
      begin = 0;
    } else if (std::abs(signal[k] - signal[k - 1]) > tolerance) {
      if (begin > 0) runs.push_back({begin, k - begin});
      begin = k;
    }
  }
  return runs;
}

Clock find_clock(std::span<const FlatRun> runs) {
  Clock clock;
  if (runs.size() < kFewestRuns) return clock;
  const auto tries = static_cast<double>(runs.size());
  const std::set<std::size_t> candidates = candidates_of(runs);
  for (const std::size_t period : candidates) {
    const auto hits = static_cast<double>(most_at_one_phase(runs, period));
    if (hits < kOnClock * tries) continue;
    const double p =
        chance(hits, tries, static_cast<double>(period)) * static_cast<double>(candidates.size());
    if (p >= clock.p) continue;
    clock = {hos::above_zero(p), period};
  }
  return clock;
}

}  // namespace loopscope::core::model
