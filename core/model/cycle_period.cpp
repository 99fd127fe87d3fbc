#include "core/model/cycle_period.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/hos/period.hpp"
#include "core/hos/sample_quantile.hpp"
#include "core/model/op_turns.hpp"

namespace loopscope::core::model {
namespace {

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
  std::ranges::sort(sorted);
  const double span = hos::sample_quantile(sorted, 0.95) - hos::sample_quantile(sorted, 0.05);
  const std::vector<OpTurn> turns = find_op_turns(op, kLargeTurn * span);
  if (turns.size() < kFewestTurns) return std::nullopt;
  const auto length = static_cast<double>(turns.back().sample - turns.front().sample);
  const double period = 2.0 * length / static_cast<double>(turns.size() - 1);
  return period >= hos::kShortestPeriod ? std::optional(period) : std::nullopt;
}

}  // namespace

std::vector<double> candidate_periods(std::span<const double> error, std::span<const double> op) {
  const double by_power =
      hos::dominant_period(error).value_or(static_cast<double>(error.size()) / kPeriodsInNoise);
  const std::optional<double> by_turns = period_of_turns(op);
  const bool same = !by_turns || std::max(*by_turns / by_power, by_power / *by_turns) < kSamePeriod;
  return same ? std::vector{by_power} : std::vector{by_power, *by_turns};
}

}  // namespace loopscope::core::model
