#include "core/model/residual_tests/tests/response_level.hpp"

#include <array>

#include "core/model/residual_tests/statistics/score_test.hpp"
#include "core/model/results/phrases.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::array kResponseLags = {0, 1, 2, 3, 5};

std::optional<Centred> square_of(const ResidualContext& questioned) {
  std::vector<double> square(questioned.view.response.begin(), questioned.view.response.end());
  for (double& x : square) {
    const double deviation = (x - questioned.response->mean) / questioned.response->std;
    x = deviation * deviation;
  }
  return centred(high_passed(square), kFewestAsked);
}

}  // namespace

std::optional<TestOutcome> ask_response_level(const ResidualContext& questioned) {
  if (!questioned.response) return std::nullopt;
  const std::optional<Centred> square = square_of(questioned);
  if (!square) return std::nullopt;
  LaggedColumns linear(square->values.size());
  linear.add(questioned.response->values, kResponseLags);
  LaggedColumns columns(square->values.size());
  columns.add(square->values, kResponseLags);
  const LinearSpan known(questioned.linear_past, linear, questioned.recorded);
  const Score score =
      score_test(known.without(questioned.residual.values), columns, known, questioned.recorded);
  if (score.freedom == 0) return std::nullopt;
  TestOutcome answer{{"response_level", score.p, {}}, {}};
  if (score.p > kSignificant) return answer;
  answer.question.statement =
      "The residual follows the square of the model's response (which spans a standard deviation "
      "of " +
      in_digits(questioned.response->std) +
      " pv units): the process gain depends on the operating point.";
  answer.nominations = {{.effect = EffectKind::process_nonlinearity, .p = score.p}};
  return answer;
}

}  // namespace loopscope::core::model
