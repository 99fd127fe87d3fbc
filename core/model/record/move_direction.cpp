#include "core/model/record/move_direction.hpp"

#include <cmath>
#include <utility>

#include "core/signal/order/order_statistic.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kNoiseSteps = 2.0;

double median_step(std::span<const double> op) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < op.size(); ++k) {
    const double step = std::abs(op[k] - op[k - 1]);
    if (step > 0.0) steps.push_back(step);  // NaN compares false
  }
  return steps.empty() ? 0.0 : signal::median(std::move(steps));
}

}  // namespace

std::vector<double> move_direction(std::span<const double> op) {
  const double noise = kNoiseSteps * median_step(op);
  std::vector<double> result(op.size(), 0.0);
  double direction = 0.0;
  double turn = std::nan("");
  for (std::size_t k = 0; k < op.size(); ++k) {
    const double value = op[k];
    if (std::isnan(turn)) turn = value;
    const bool further = direction * (value - turn) > 0.0;
    if (further) turn = value;
    if (std::abs(value - turn) > noise) {
      direction = value > turn ? 1.0 : -1.0;
      turn = value;
    }
    result[k] = direction;
  }
  return result;
}

}  // namespace loopscope::core::model
