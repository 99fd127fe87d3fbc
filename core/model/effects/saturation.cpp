#include "core/model/effects/saturation.hpp"

#include <algorithm>
#include <cmath>

#include "core/text/phrases.hpp"

namespace loopscope::core::model {

void Saturation::shape_flow(std::span<double> flow) const {
  for (double& value : flow) value = std::clamp(value, low_, high_);
}

std::vector<EffectPtr> Saturation::neighbours(double scale) const {
  constexpr double kMove = 1.0;  // % of op
  std::vector<EffectPtr> result;
  for (const double move : {-kMove * scale, kMove * scale}) {
    if (std::isfinite(low_) && low_ + move < high_) {
      result.push_back(std::make_shared<Saturation>(low_ + move, high_));
    }
    if (std::isfinite(high_) && high_ + move > low_) {
      result.push_back(std::make_shared<Saturation>(low_, high_ + move));
    }
  }
  return result;
}

std::vector<Parameter> Saturation::parameters(const LoopData& data, std::span<const double>,
                                              double) const {
  const double low = std::max(0.0, data.op_mean + low_);
  const double high = std::min(100.0, data.op_mean + high_);
  return {{"low", "%", low, {}, {}}, {"high", "%", high, {}, {}}};
}

std::string Saturation::words(std::span<const Parameter> parameters) const {
  return "The valve follows the controller output between " + text::number(parameters[0].value) +
         " and " + text::number(parameters[1].value) + " % only.";
}

}  // namespace loopscope::core::model
