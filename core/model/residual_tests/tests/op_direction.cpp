#include "core/model/residual_tests/tests/op_direction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/hos/numeric/quantile.hpp"
#include "core/model/residual_tests/statistics/score_test.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::array kFilterWidths = {0.25, 0.75, 2.25};

/// Half the distance between the 16th and the 84th percentile: the standard deviation of Gaussian
/// values, and one setpoint move does not change it.
double usual_deviation(std::span<const double> op_sorted) {
  return 0.5 * (hos::sample_quantile(op_sorted, 0.84) - hos::sample_quantile(op_sorted, 0.16));
}

std::size_t count_reversals(std::span<const double> direction) {
  std::size_t count = 0;
  double last = 0.0;
  for (const double now : direction) {
    if (std::isnan(now) || now == 0.0) continue;
    count += last != 0.0 && now != last ? 1 : 0;
    last = now;
  }
  return count;
}

/// The width of the column with the most standard errors.
std::size_t strongest_width(const Eigen::VectorXd& t, const std::vector<double>& widths) {
  Eigen::Index strongest = 0;
  t.cwiseAbs().maxCoeff(&strongest);
  return std::min(static_cast<std::size_t>(strongest) / ResidualContext::kOpLags.size(),
                  widths.size() - 1);
}

std::string statement_of(const ResidualContext& context, double width_percent) {
  return "The residual depends on the direction of the last move of op, beyond op itself (" +
         std::to_string(count_reversals(context.view.op_direction)) + " reversals), most as with " +
         text::number(width_percent) + " % of dead band: hysteresis between op and pv.";
}

}  // namespace

std::vector<double> lag_of_play(std::span<const double> op_percent, double width_percent) {
  const double half = 0.5 * width_percent;
  std::vector<double> lag(op_percent.size(), std::numeric_limits<double>::quiet_NaN());
  double position = lag.empty() ? 0.0 : lag.front();
  for (std::size_t k = 0; k < lag.size(); ++k) {
    const double op = op_percent[k];
    if (!std::isfinite(op)) continue;
    position = std::isnan(position) ? op : std::clamp(position, op - half, op + half);
    lag[k] = position - op;
  }
  return lag;
}

std::optional<TestOutcome> test_op_direction(const ResidualContext& context) {
  if (!context.op) return std::nullopt;
  const double usual = usual_deviation(context.op_sorted);
  std::vector<Centred> lags;
  std::vector<double> widths;
  for (const double share : kFilterWidths) {
    auto lag =
        centred(high_passed(lag_of_play(context.view.op_percent, share * usual)), kFewestAsked);
    if (!lag) continue;
    widths.push_back(share * usual);
    lags.push_back(std::move(*lag));
  }
  if (widths.empty()) return std::nullopt;
  LaggedColumns columns(context.view.op_percent.size());
  for (const Centred& lag : lags) columns.add(lag.values, ResidualContext::kOpLags);
  const Score score =
      score_test(context.beyond_linear, columns, context.linear_past, context.recorded);
  if (score.freedom == 0) return std::nullopt;
  TestOutcome answer{{"op_direction", score.p, {}}, {}};
  if (score.p > kSignificant) return answer;
  answer.question.statement = statement_of(context, widths.at(strongest_width(score.t, widths)));
  for (const EffectKind effect : {EffectKind::valve_stiction, EffectKind::valve_deadband})
    answer.nominations.push_back({.effect = effect, .p = score.p});
  return answer;
}

}  // namespace loopscope::core::model
