#include "core/model/residual_tests/tests/op_level.hpp"

#include <algorithm>
#include <array>

#include "core/hos/coupling/combine_p.hpp"
#include "core/hos/numeric/quantile.hpp"
#include "core/model/residual_tests/statistics/score_test.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// Shares of the samples on the near side of a limit that is tried.
constexpr std::array kShares = {0.65, 0.92};

/// p of op passed through `map`; 1 where that says nothing.
template <class Map>
double p_of(const ResidualContext& context, Map map) {
  std::vector<double> mapped(context.view.op_percent.begin(), context.view.op_percent.end());
  for (double& value : mapped) value = map(value);
  const std::optional<Centred> feature = centred(high_passed(mapped), kFewestAsked);
  if (!feature) return 1.0;
  LaggedColumns columns(mapped.size());
  columns.add(feature->values, ResidualContext::kOpLags);
  return score_test(context.beyond_linear, columns, context.linear_past, context.recorded).p;
}

struct Limit {
  double at_percent = 0.0;
  bool high = true;
  double share = 0.0;  ///< of the samples beyond
  double p = 1.0;
};

Limit try_limit(const ResidualContext& context, double share, bool high) {
  const double near = high ? share : 1.0 - share;
  Limit limit{hos::sample_quantile(context.op_sorted, near), high, 1.0 - share, 1.0};
  limit.p = p_of(context, [&limit](double op) {
    return limit.high ? std::max(op - limit.at_percent, 0.0 * op)
                      : std::min(op - limit.at_percent, 0.0 * op);
  });
  return limit;
}

std::vector<Limit> try_limits(const ResidualContext& context) {
  std::vector<Limit> limits;
  for (const bool high : {true, false})
    for (const double share : kShares) limits.push_back(try_limit(context, share, high));
  return limits;
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
  const double curved_p = p_of(context, [mean](double op) { return (op - mean) * (op - mean); });
  const std::vector<Limit> limits = try_limits(context);
  std::vector<double> parts = {curved_p};
  for (const Limit& limit : limits) parts.push_back(limit.p);
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
