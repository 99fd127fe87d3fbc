#include "core/model/residual_tests/tests/time_gain.hpp"

#include <algorithm>
#include <array>

#include "core/hos/coupling/combine_p.hpp"
#include "core/model/residual_tests/statistics/change_point.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

struct FoundGain {
  ChangePoint change;
  double ratio = 1.0;  ///< gain after over gain before
};

/// What the gain of the part of the residual that follows `answer` is, in shares of the model's.
double slope(std::span<const double> products, std::span<const double> answer, double unit) {
  double product = 0.0;
  double square = 0.0;
  for (std::size_t k = 0; k < products.size(); ++k) {
    if (products[k] == 0.0) continue;
    product += products[k];
    square += answer[k] * answer[k];
  }
  return square > 0.0 ? unit * product / square : 0.0;
}

FoundGain judge(const Centred& residual, const Centred& answer) {
  std::vector<double> products(residual.values.size());
  std::transform(residual.values.begin(), residual.values.end(), answer.values.begin(),
                 products.begin(), [](double r, double x) { return r * x; });
  FoundGain result{find_change(products), 1.0};
  const std::span<const double> all(products);
  const std::span<const double> x(answer.values);
  const std::size_t split = result.change.at_sample;
  const double unit = residual.std / answer.std;
  const double before = 1.0 + slope(all.first(split), x.first(split), unit);
  const double after = 1.0 + slope(all.subspan(split), x.subspan(split), unit);
  // Outside this the fit before or after has lost the process.
  constexpr double kFarthest = 20.0;
  if (before > 0.0 && after > 0.0)
    result.ratio = std::clamp(after / before, 1.0 / kFarthest, kFarthest);
  return result;
}

}  // namespace

std::optional<TestOutcome> test_time_gain(const ResidualContext& context) {
  if (!context.response) return std::nullopt;
  const FoundGain level = judge(context.fresh, *context.response);
  FoundGain move;
  if (const auto moves = centred(increments(context.view.response), kFewestAsked))
    move = judge(context.fresh, *moves);
  const std::array parts = {level.change.p, move.change.p};
  TestOutcome answer{{"time_gain", hos::combine_p(parts), {}}, {}};
  if (answer.question.p > kSignificant) return answer;
  const FoundGain& best = level.change.p <= move.change.p ? level : move;
  answer.question.statement =
      "The process responds about " + text::number(best.ratio) + " times as strongly from " +
      text::at_place(best.change.at_sample, context.view.sample_interval_s) + " on.";
  answer.nominations = {{.effect = EffectKind::gain_change,
                         .p = best.change.p,
                         .at_sample = best.change.at_sample,
                         .gain_ratio = best.ratio}};
  return answer;
}

}  // namespace loopscope::core::model
