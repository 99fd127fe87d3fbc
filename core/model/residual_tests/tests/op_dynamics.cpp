#include "core/model/residual_tests/tests/op_dynamics.hpp"

#include <array>

#include "core/model/residual_tests/statistics/score_test.hpp"
#include "core/text/counted.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::array kMoveLags = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 20};

std::string statement_of(const Score& score, double sample_interval_s) {
  Eigen::Index strongest = 0;
  score.t.cwiseAbs().maxCoeff(&strongest);
  const auto lag = kMoveLags.at(static_cast<std::size_t>(strongest));
  return "The residual follows moves of op, most those of " +
         text::duration(lag * sample_interval_s) + " (" + text::counted(lag, "sample", "samples") +
         ") before, " + text::number(std::abs(score.t[strongest])) +
         " standard errors: the linear model's dead time or order does not fit.";
}

}  // namespace

std::optional<TestOutcome> test_op_dynamics(const ResidualContext& context) {
  if (!context.op) return std::nullopt;
  const std::optional<Centred> moves = centred(increments(context.view.op_percent), kFewestAsked);
  if (!moves) return std::nullopt;
  LaggedColumns columns(moves->values.size());
  columns.add(moves->values, kMoveLags);
  const Score score = score_test(context.constant.without(context.residual.values), columns,
                                 context.constant, context.recorded);
  if (score.freedom == 0) return std::nullopt;
  TestOutcome answer{{"op_dynamics", score.p, {}}, {}};
  if (score.p <= kSignificant)
    answer.question.statement = statement_of(score, context.view.sample_interval_s);
  return answer;
}

}  // namespace loopscope::core::model
