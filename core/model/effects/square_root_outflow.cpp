#include "core/model/effects/square_root_outflow.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/effects/curvature.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// Of the depth: where the vessel is about to run dry the root has no slope.
constexpr double kNearlyDry = 0.02;
/// A linear model takes a slow vessel for an integrator: 100 samples.
constexpr double kSlowestPole = 0.99;

/// The flow as it comes into the vessel: delay, numerator and the faster lag are behind it.
std::vector<double> inflow(const ProcessShape& process, std::span<const double> flow) {
  ProcessShape before;
  before.delay_samples = process.delay_samples;
  before.pole =
      process.integrating ? process.second_pole : std::min(process.pole, process.second_pole);
  before.numerator = process.numerator;
  return answer(before, flow);
}

double vessel_pole(const ProcessShape& process) {
  const double slower = process.integrating ? 1.0 : std::max(process.pole, process.second_pole);
  return std::min(slower, kSlowestPole);
}

/// One sample of a vessel of time constant `rate`^-1 samples, its outflow straight about `level`.
double filled(double level, double inflow, double depth, double rate) {
  const double root = std::sqrt(std::max(1.0 + level / depth, kNearlyDry));
  const double outflow = 2.0 * depth * (root - 1.0);
  return level - (inflow - outflow) * std::expm1(-rate / root) * root;
}

}  // namespace

void SquareRootOutflow::add_columns(const Signals& signals, std::vector<Column>& columns) const {
  Column column = inflow(signals.process, signals.flow);
  const double pole = vessel_pole(signals.process);
  const double rate = -std::log(std::max(pole, 1e-6));
  const double lowest = (kNearlyDry - 1.0) * std::abs(depth_);
  double level = column.empty() ? 0.0 : std::clamp(column.front(), lowest, -lowest);
  double straight = column.empty() ? 0.0 : column.front();
  for (double& value : column) {
    level = filled(level, value, depth_, rate);
    // An empty vessel stays empty, however little flows in.
    level = depth_ > 0.0 ? std::max(level, lowest) : std::min(level, -lowest);
    straight += (1.0 - pole) * (value - straight);
    value = level - straight;
  }
  columns.push_back(std::move(column));
}

std::vector<EffectPtr> SquareRootOutflow::neighbours(double scale) const {
  constexpr double kMove = 0.5;  // of the logarithm
  return {std::make_shared<SquareRootOutflow>(depth_ * std::exp(kMove * scale)),
          std::make_shared<SquareRootOutflow>(depth_ * std::exp(-kMove * scale))};
}

std::vector<Parameter> SquareRootOutflow::parameters(const LoopData& data,
                                                     std::span<const double> coefficients,
                                                     double gain) const {
  // At rest x = f + f^2 / (4 D): as in curvature.cpp, c / 50 = s / g^2.
  const double square = coefficients[0] / (4.0 * depth_) * data.pv_scale;
  const double real_gain = gain * data.pv_scale;
  const double curvature = real_gain == 0.0 ? 0.0 : kHalfSpan * square / (real_gain * real_gain);
  return {{"curvature", "", curvature, {}, {}}};
}

std::string SquareRootOutflow::words(std::span<const Parameter> parameters) const {
  return "The process behaves as a vessel whose outflow grows with the square root of its level: "
         "curvature " +
         text::number(parameters[0].value) +
         ", gain and time constant change with the process variable.";
}

}  // namespace loopscope::core::model
