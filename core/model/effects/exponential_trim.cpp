#include "core/model/effects/exponential_trim.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/effects/curvature.hpp"

namespace loopscope::core::model {
namespace {

/// Below it the exponential is a parabola up to rounding.
constexpr double kStraight = 1e-4;
/// A gain that grows to its fiftyfold from one end of the moves to the other; no trim has more.
constexpr double kSteepest = 2.0;

/// (e^ax - 1 - ax) / a^2: what the trim adds to a straight one of the same slope at 0.
double bend(double growth, double travel) {
  if (std::abs(growth) < kStraight) return 0.5 * travel * travel;
  return (std::expm1(growth * travel) - growth * travel) / (growth * growth);
}

}  // namespace

void ExponentialTrim::add_columns(const Signals& signals, std::vector<Column>& columns) const {
  Column bent(signals.flow.begin(), signals.flow.end());
  for (double& value : bent) value = bend(growth_, value / travel_percent_);
  columns.push_back(answer(signals.process, bent));
}

std::vector<EffectPtr> ExponentialTrim::neighbours(double scale) const {
  constexpr double kMove = 0.2;
  std::vector<EffectPtr> result;
  for (const double move : {-kMove * scale, kMove * scale}) {
    const double growth = std::clamp(growth_ + move, -kSteepest, kSteepest);
    if (growth != growth_)
      result.push_back(std::make_shared<ExponentialTrim>(growth, travel_percent_));
  }
  return result;
}

std::vector<Parameter> ExponentialTrim::parameters(const LoopData& data,
                                                   std::span<const double> coefficients,
                                                   double gain) const {
  const double middle = (kHalfSpan - data.op_mean) / travel_percent_;
  const double risen =
      std::abs(growth_) < kStraight ? middle : std::expm1(growth_ * middle) / growth_;
  const double slope = gain + coefficients[0] * risen / travel_percent_;
  const double second =
      coefficients[0] * std::exp(growth_ * middle) / (travel_percent_ * travel_percent_);
  return {{"curvature", "", slope == 0.0 ? 0.0 : second * kHalfSpan / (2.0 * slope), {}, {}}};
}

std::string ExponentialTrim::words(std::span<const Parameter> parameters) const {
  return ValveCharacteristic().words(parameters);
}

}  // namespace loopscope::core::model
