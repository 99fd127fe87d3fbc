#include "core/model/residual_tests/statistics/residual_context.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

#include "core/model/residual_tests/statistics/centred.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kKept = 0.98;

/// Root mean square of the smaller values.
double trimmed_rms(std::span<const double> values) {
  std::vector<double> squares;
  for (const double value : values)
    if (std::isfinite(value)) squares.push_back(value * value);
  const auto kept = static_cast<std::size_t>(kKept * static_cast<double>(squares.size()));
  if (kept == 0) return 0.0;
  std::nth_element(squares.begin(), squares.begin() + static_cast<std::ptrdiff_t>(kept),
                   squares.end());
  double sum = 0.0;
  for (std::size_t k = 0; k < kept; ++k) sum += squares[k];
  return std::sqrt(sum / static_cast<double>(kept));
}

void check(const ResidualView& view) {
  const std::size_t size = view.innovation.size();
  for (const std::span<const double> signal :
       std::array{view.op_percent, view.op_direction, view.response, view.pv})
    if (signal.size() != size) throw std::invalid_argument("residual: signals differ in length");
  if (!(view.sample_interval_s > 0.0))
    throw std::invalid_argument("residual: the sample interval must be positive");
}

/// Each sample of a few, then further apart.
constexpr std::array kPastLags = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 17, 20, 25, 30};
constexpr std::array kLinearOpLags = {1,  2,  3,  4,  5,  6,  7,  8,  9, 10,
                                      11, 12, 14, 16, 20, 25, 30, 40, 60};

/// A missing sample stays 0.
Centred fresh_of(const ResidualContext& context) {
  Centred result{{context.beyond_linear.begin(), context.beyond_linear.end()},
                 context.residual.recorded,
                 0.0,
                 context.residual.std};
  const double square = context.beyond_linear.squaredNorm();
  const double std = std::sqrt(square / static_cast<double>(result.recorded));
  if (!(std > 0.0)) return context.residual;
  for (double& value : result.values) value /= std;
  result.std *= std;
  return result;
}

}  // namespace

double fast_noise_std(const ResidualView& view) {
  return std::max(trimmed_rms(increments(view.pv)) / std::numbers::sqrt2,
                  trimmed_rms(view.innovation));
}

std::optional<ResidualContext> prepare_context(const ResidualView& view) {
  check(view);
  std::optional<Centred> residual = centred(view.innovation, kFewestAsked);
  if (!residual) return std::nullopt;
  ResidualContext result{
      .view = view,
      .residual = std::move(*residual),
      .op = centred(view.op_percent, kFewestAsked),
      .response = centred(view.response, kFewestAsked),
      .pv = centred(view.pv, kFewestAsked),
      .op_sorted = sorted_finite(view.op_percent),
      .fast_noise_std = fast_noise_std(view),
      .grid = {},
      .recorded = Eigen::ArrayXd(static_cast<Eigen::Index>(view.innovation.size())),
      .constant = {},
      .linear_past = {},
      .beyond_linear = {},
      .fresh = {}};
  for (Eigen::Index k = 0; k < result.recorded.size(); ++k)
    result.recorded[k] = std::isfinite(view.innovation[static_cast<std::size_t>(k)]) ? 1.0 : 0.0;

  LaggedColumns columns(view.innovation.size());
  result.constant = LinearSpan(columns, result.recorded);
  columns.add(result.residual.values, kPastLags);
  if (result.op) columns.add(result.op->values, kLinearOpLags);
  result.linear_past = LinearSpan(columns, result.recorded);
  result.beyond_linear = result.linear_past.without(result.residual.values);
  result.fresh = fresh_of(result);
  if (result.pv) result.grid = find_grid(view.pv, result.fast_noise_std);
  return result;
}

}  // namespace loopscope::core::model
