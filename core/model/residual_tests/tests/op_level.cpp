#include "core/model/residual_tests/tests/op_level.hpp"

#include <algorithm>
#include <array>
#include <functional>

#include "core/hos/coupling/combine_p.hpp"
#include "core/hos/numeric/quantile.hpp"
#include "core/model/residual_tests/statistics/score_test.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// Shares of the samples on the near side of a limit that is tried.
constexpr std::array kShares = {0.65, 0.92};

/// A figure of op that the residual may follow.
std::optional<Centred> feature_of(const ResidualContext& context,
                                  const std::function<double(double)>& map) {
  std::vector<double> mapped(context.view.op_percent.begin(), context.view.op_percent.end());
  for (double& value : mapped) value = map(value);
  return centred(high_passed(mapped), kFewestAsked);
}

struct Limit {
  double at_percent = 0.0;
  bool high = true;
  double share = 0.0;  ///< of the samples beyond
  double p = 1.0;
  [[nodiscard]] double beyond(double op) const {
    return high ? std::max(op - at_percent, 0.0 * op) : std::min(op - at_percent, 0.0 * op);
  }
};

std::vector<Limit> limits_of(const ResidualContext& context) {
  std::vector<Limit> limits;
  for (const bool high : {true, false}) {
    for (const double share : kShares)
      limits.push_back(
          {hos::sample_quantile(context.op_sorted, high ? share : 1.0 - share), high, 1.0 - share});
  }
  return limits;
}

/// Of each feature; 1 where there is none.
std::vector<double> p_of(const ResidualContext& context,
                         const std::vector<std::optional<Centred>>& features) {
  LaggedColumns columns(context.view.op_percent.size());
  for (const std::optional<Centred>& feature : features)
    if (feature) columns.add(feature->values, ResidualContext::kOpLags);
  constexpr Eigen::Index kTogether = ResidualContext::kOpLags.size();
  const std::vector<Score> scores =
      score_tests(context.beyond_linear, columns, kTogether, context.linear_past, context.recorded);
  std::vector<double> p;
  auto score = scores.begin();
  for (const std::optional<Centred>& feature : features) p.push_back(feature ? (score++)->p : 1.0);
  return p;
}

Nomination saturation_of(const Limit& limit) {
  Nomination nomination{.effect = EffectKind::valve_saturation, .p = limit.p};
  (limit.high ? nomination.high_percent : nomination.low_percent) = limit.at_percent;
  return nomination;
}

std::string statement_of(double curved_p, const Limit& limit) {
  if (curved_p <= limit.p)
    return "Moves of op have more effect at one end of its range than at the other: the residual "
           "follows "
           "the square of op.";
  return "Moves of op " + std::string(limit.high ? "above " : "below ") +
         text::number(limit.at_percent) + " % (" + text::percent(limit.share) +
         " of the samples) have another effect on pv than the others.";
}

}  // namespace

std::optional<TestOutcome> test_op_level(const ResidualContext& context) {
  if (!context.op) return std::nullopt;
  const double mean = context.op->mean;
  std::vector<Limit> limits = limits_of(context);
  std::vector<std::optional<Centred>> features;
  features.push_back(feature_of(context, [mean](double op) { return (op - mean) * (op - mean); }));
  for (const Limit& limit : limits)
    features.push_back(feature_of(context, [&](double op) { return limit.beyond(op); }));
  const std::vector<double> parts = p_of(context, features);
  const double curved_p = parts.front();
  for (std::size_t i = 0; i < limits.size(); ++i) limits[i].p = parts[i + 1];
  TestOutcome answer{{"op_level", hos::combine_p(parts), {}}, {}};
  if (answer.question.p > kSignificant) return answer;
  const Limit best = *std::min_element(limits.begin(), limits.end(),
                                       [](const Limit& a, const Limit& b) { return a.p < b.p; });
  answer.question.statement = statement_of(curved_p, best);
  answer.nominations = {{.effect = EffectKind::valve_characteristic, .p = curved_p},
                        saturation_of(best)};
  if (best.p < curved_p) std::swap(answer.nominations[0], answer.nominations[1]);
  return answer;
}

}  // namespace loopscope::core::model
