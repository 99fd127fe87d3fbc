#include "core/model/limit_cycle/cycle_band.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/hos/numeric/quantile.hpp"
#include "core/hos/slow/period.hpp"
#include "core/model/valve_law/op_turns.hpp"
#include "core/signal/order/sort_values.hpp"

namespace loopscope::core::model {
namespace {

/// Kept samples a cycle at least (where the recording has them): five to a tenth harmonic's half.
constexpr double kKeptPerCycle = 20.0;
/// Width of the long mean, cycles. Shorter ones eat the cycle itself, longer ones let the load in.
constexpr double kLongCycles = 2.5;
constexpr std::size_t kShortestLongHalf = 8;

/// Of all before each, and of all.
std::vector<double> sums_before(std::span<const double> kept) {
  std::vector<double> sums(kept.size() + 1, 0.0);
  for (std::size_t k = 0; k < kept.size(); ++k) sums[k + 1] = sums[k] + kept[k];
  return sums;
}

double mean_around(std::span<const double> sums, std::size_t k, std::size_t half) {
  const std::size_t first = k - std::min(k, half);
  const std::size_t last = std::min(sums.size() - 1, k + half + 1);
  return (sums[last] - sums[first]) / static_cast<double>(last - first);
}

/// Noise wanders too; its period stands for the scale at which it does.
constexpr double kPeriodsInNoise = 9.0;
/// Share of op's span that a large turn goes back by: more than noise, less than a full swing.
constexpr double kLargeTurn = 0.4;
/// Five cycles.
constexpr std::size_t kFewestTurns = 10;
/// Nearer than this two periods are one: the band of a cycle is wider.
constexpr double kSamePeriod = 1.25;

std::optional<double> period_of_turns(std::span<const double> op) {
  std::vector<double> sorted(op.begin(), op.end());
  signal::sort_values(sorted);
  const double span = hos::sample_quantile(sorted, 0.95) - hos::sample_quantile(sorted, 0.05);
  const std::vector<OpTurn> turns = find_op_turns(op, kLargeTurn * span);
  if (turns.size() < kFewestTurns) return std::nullopt;
  const auto length = static_cast<double>(turns.back().sample - turns.front().sample);
  const double period = 2.0 * length / static_cast<double>(turns.size() - 1);
  return period >= hos::kShortestPeriod ? std::optional(period) : std::nullopt;
}

}  // namespace

CycleBand::CycleBand(double period_samples)
    : factor_(std::max<std::size_t>(1, static_cast<std::size_t>(period_samples / kKeptPerCycle))),
      period_(period_samples / static_cast<double>(factor_)),
      long_half_(
          std::max(kShortestLongHalf, static_cast<std::size_t>(0.5 * kLongCycles * period_))),
      short_half_(static_cast<std::size_t>(std::lround(period_ / kKeptPerCycle))) {}

std::vector<double> CycleBand::resample(std::span<const double> samples) const {
  std::vector<double> kept(samples.size() / factor_);
  best_cycle_kernel().resample(samples, 1, factor_, kept.data());
  return kept;
}

std::vector<EightNumbers> CycleBand::resample(std::span<const EightNumbers> samples) const {
  std::vector<EightNumbers> kept(samples.size() / factor_);
  best_cycle_kernel().resample(flat(samples), kSideBySide, factor_, first_of(kept));
  return kept;
}

std::vector<double> CycleBand::drift(std::span<const double> kept) const {
  const std::vector<double> sums = sums_before(kept);
  std::vector<double> drift(kept.size());
  for (std::size_t k = 0; k < kept.size(); ++k) drift[k] = mean_around(sums, k, long_half_);
  return drift;
}

std::vector<double> CycleBand::pass(std::span<const double> kept) const {
  std::vector<double> passed(kept.size());
  best_cycle_kernel().pass(widths(), sums_before(kept), 1, passed.data());
  return passed;
}

std::vector<EightNumbers> CycleBand::pass_sums(std::span<const EightNumbers> sums) const {
  std::vector<EightNumbers> passed(sums.size() - 1);
  best_cycle_kernel().pass(widths(), flat(sums), kSideBySide, first_of(passed));
  return passed;
}

std::vector<double> candidate_periods(std::span<const double> error, std::span<const double> op) {
  const double by_power =
      hos::dominant_period(error).value_or(static_cast<double>(error.size()) / kPeriodsInNoise);
  const std::optional<double> by_turns = period_of_turns(op);
  const bool same = !by_turns || std::max(*by_turns / by_power, by_power / *by_turns) < kSamePeriod;
  return same ? std::vector{by_power} : std::vector{by_power, *by_turns};
}

}  // namespace loopscope::core::model
