#include "core/model/put_questions.hpp"

#include <cmath>
#include <optional>

#include "core/model/op_direction.hpp"
#include "core/model/questions/op_direction.hpp"
#include "core/model/questions/questioned.hpp"

namespace loopscope::core::model {
namespace {

/// The one-step errors of every sample that counts, pv units; NaN elsewhere.
std::vector<double> residual_of(const LoopData& data, const Fit& fit) {
  std::vector<double> residual(data.size(), std::nan(""));
  for (const auto* rows : {&data.rows.fit, &data.rows.score}) {
    for (const Range& range : *rows) {
      for (std::size_t k = range.first; k < range.end; ++k)
        residual[k] = fit.innovations[k] * data.pv_scale;
    }
  }
  return residual;
}

}  // namespace

std::vector<double> response_of(const LoopData& data, const Fit& fit) {
  std::vector<double> response = deterministic_output(data, fit);
  for (double& value : response) value *= data.pv_scale;
  return response;
}

std::vector<Answer> question(const ModelInput& input, const LoopData& data, const Fit& fit,
                             Depth depth, const std::vector<Answer>& known) {
  const std::vector<double> residual = residual_of(data, fit);
  const std::vector<double> direction = op_direction(input.op);
  const std::vector<double> response = response_of(data, fit);
  const ResidualView view{residual, input.op, direction,
                          response, input.pv, input.sample_interval_s};
  if (depth == Depth::first) return question_residual_first(view);
  return depth == Depth::quick ? question_residual_quickly(view)
                               : question_residual(view, input.seed, known);
}

double p_of_op_direction(const LoopData& data, const Fit& fit) {
  const std::vector<double> residual = residual_of(data, fit);
  const std::vector<double> op = at_rows(data.grid, data.op);
  const std::vector<double> direction = op_direction(op);
  const std::vector<double> nothing(data.size(), std::nan(""));
  const std::optional<Questioned> questioned =
      prepare_questions({residual, op, direction, nothing, nothing, data.sample_interval_s});
  const std::optional<Answer> answer = questioned ? ask_op_direction(*questioned) : std::nullopt;
  return answer ? answer->question.p : 1.0;
}

}  // namespace loopscope::core::model
