#include "core/model/questions/questioned.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include "core/model/questions/fast_noise.hpp"
#include "core/model/questions/score_test.hpp"

namespace loopscope::core::model {
namespace {

void check(const ResidualView& view) {
  const std::size_t size = view.innovation.size();
  for (const std::span<const double> signal :
       std::array{view.op_percent, view.op_direction, view.response, view.pv})
    if (signal.size() != size) throw std::invalid_argument("residual: signals differ in length");
  if (!(view.sample_interval_s > 0.0))
    throw std::invalid_argument("residual: the sample interval must be positive");
}

}  // namespace

std::optional<Questioned> prepare_questions(const ResidualView& view) {
  check(view);
  std::optional<Centred> residual = centred(view.innovation, kFewestAsked);
  if (!residual) return std::nullopt;
  Questioned result{.view = view,
                    .residual = std::move(*residual),
                    .op = centred(view.op_percent, kFewestAsked),
                    .response = centred(view.response, kFewestAsked),
                    .pv = centred(view.pv, kFewestAsked),
                    .op_sorted = sorted_finite(view.op_percent),
                    .fast_noise_std = fast_noise_std(view),
                    .grid = {},
                    .recorded = Eigen::ArrayXd(static_cast<Eigen::Index>(view.innovation.size())),
                    .constant = {},
                    .past_op = {},
                    .beyond_op = {}};
  for (Eigen::Index k = 0; k < result.recorded.size(); ++k)
    result.recorded[k] = std::isfinite(view.innovation[static_cast<std::size_t>(k)]) ? 1.0 : 0.0;

  LaggedColumns columns(view.innovation.size());
  result.constant = orthonormal(columns, result.recorded);
  if (result.op) columns.add(result.op->values, Questioned::kOpLags);
  result.past_op = orthonormal(columns, result.recorded);
  result.beyond_op = without(result.past_op, result.residual.values);
  if (result.pv) result.grid = find_grid(view.pv, result.fast_noise_std);
  return result;
}

}  // namespace loopscope::core::model
