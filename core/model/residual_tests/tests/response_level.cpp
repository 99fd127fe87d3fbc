#include "core/model/residual_tests/tests/response_level.hpp"

#include <array>

#include "core/model/residual_tests/statistics/score_test.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::array kResponseLags = {0, 1, 2, 3, 5};

std::optional<Centred> square_of(const ResidualContext& context) {
  std::vector<double> square(context.view.response.begin(), context.view.response.end());
  for (double& x : square) {
    const double deviation = (x - context.response->mean) / context.response->std;
    x = deviation * deviation;
  }
  return centred(high_passed(square), kFewestAsked);
}

}  // namespace

std::optional<TestOutcome> test_response_level(const ResidualContext& context) {
  if (!context.response) return std::nullopt;
  const std::optional<Centred> square = square_of(context);
  if (!square) return std::nullopt;
  LaggedColumns linear(square->values.size());
  linear.add(context.response->values, kResponseLags);
  LaggedColumns columns(square->values.size());
  columns.add(square->values, kResponseLags);
  const LinearSpan known(context.linear_past, linear, context.recorded);
  const Score score =
      score_test(known.without(context.residual.values), columns, known, context.recorded);
  if (score.freedom == 0) return std::nullopt;
  TestOutcome answer{{"response_level", score.p, {}}, {}};
  if (score.p > kSignificant) return answer;
  answer.question.statement =
      "The process gain depends on the operating point: the residual follows the square of the "
      "model's response, whose standard deviation is " +
      text::units_of_pv(context.response->std) + ".";
  answer.nominations = {{.effect = EffectKind::process_nonlinearity, .p = score.p}};
  return answer;
}

}  // namespace loopscope::core::model
