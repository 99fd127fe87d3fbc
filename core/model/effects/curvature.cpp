#include "core/model/effects/curvature.hpp"

#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// Distances are taken in tens of percent, so that powers stay near one.
constexpr double kUnit = 10.0;

Column square_of(std::span<const double> values) {
  Column result(values.begin(), values.end());
  for (double& value : result) value = value / kUnit * (value / kUnit);
  return result;
}

Column cube_of(std::span<const double> values) {
  Column result(values.begin(), values.end());
  for (double& value : result) value = value / kUnit * (value / kUnit) * (value / kUnit);
  return result;
}

}  // namespace

void ValveCharacteristic::add_columns(const Signals& signals, std::vector<Column>& columns) const {
  columns.push_back(answer(signals.process, square_of(signals.flow)));
  columns.push_back(answer(signals.process, cube_of(signals.flow)));
}

std::vector<Parameter> ValveCharacteristic::parameters(const LoopData& data,
                                                       std::span<const double> coefficients,
                                                       double gain) const {
  const double square = coefficients[0] / (kUnit * kUnit);
  const double cube = coefficients[1] / (kUnit * kUnit * kUnit);
  const double middle = kHalfSpan - data.op_mean;
  const double slope = gain + 2.0 * square * middle + 3.0 * cube * middle * middle;
  const double bend = 2.0 * square + 6.0 * cube * middle;
  return {{"curvature", "", slope == 0.0 ? 0.0 : bend * kHalfSpan / (2.0 * slope), {}, {}}};
}

void ProcessNonlinearity::add_columns(const Signals& signals, std::vector<Column>& columns) const {
  columns.push_back(square_of(signals.response));
  columns.push_back(cube_of(signals.response));
}

std::vector<Parameter> ProcessNonlinearity::parameters(const LoopData& data,
                                                       std::span<const double> coefficients,
                                                       double gain) const {
  // Static curve in pv: y = g r + s r^2 with r the answer of gain 1, so c / 50 = s / g^2.
  const double square = coefficients[0] / (kUnit * kUnit) * data.pv_scale;
  const double real_gain = gain * data.pv_scale;
  return {{"curvature",
           "",
           real_gain == 0.0 ? 0.0 : kHalfSpan * square / (real_gain * real_gain),
           {},
           {}}};
}

std::string ValveCharacteristic::words(std::span<const Parameter> parameters) const {
  return "The flow is not proportional to the valve's travel: curvature " +
         text::number(parameters[0].value) + ", the gain changes with the output.";
}

std::string ProcessNonlinearity::words(std::span<const Parameter> parameters) const {
  return "The process gain depends on the operating point: curvature " +
         text::number(parameters[0].value) + ", the gain changes with the process variable.";
}

}  // namespace loopscope::core::model
