#include "core/model/fit/process_report.hpp"

#include <cmath>

#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

double time_constant(double pole, double interval_s) {
  return pole <= 0.0 ? 0.0 : -interval_s / std::log(pole);
}

std::string noise_words(const Fit& fit) {
  const NoiseModel& noise = fit.structure.noise;
  std::string poles, zeros;
  for (std::size_t i = 0; i < noise.order; ++i) {
    poles += text::sentence(i == 0 ? "" : ", ", noise.poles[i]);
    zeros += text::sentence(i == 0 ? "" : ", ", noise.zeros[i]);
  }
  return "noise with poles " + poles + " and numerator 1, " + zeros;
}

}  // namespace

ProcessFit report_process(const LoopData& data, const Fit& fit) {
  const ProcessShape& shape = fit.structure.process;
  const double interval = data.sample_interval_s;
  ProcessFit process;
  process.integrating = shape.integrating;
  process.gain = fit.gain() * data.pv_scale / (shape.integrating ? interval : 1.0);
  process.time_constant_s = shape.integrating ? 0.0 : time_constant(shape.pole, interval);
  process.second_time_constant_s = time_constant(shape.second_pole, interval);
  process.delay_s = static_cast<double>(shape.delay_samples) * interval;
  if (process.second_time_constant_s > process.time_constant_s && !shape.integrating) {
    std::swap(process.time_constant_s, process.second_time_constant_s);
  }
  return process;
}

SampledProcess sampled(const LoopData& data, const Fit& fit) {
  const ProcessShape& shape = fit.structure.process;
  const double lags =
      (shape.integrating ? 1.0 : 1.0 - shape.pole) * (1.0 - shape.second_pole) * data.pv_scale;
  SampledProcess process;
  process.delay_samples = shape.delay_samples;
  process.numerator = {fit.coefficients[0] * lags};
  if (fit.structure.two_taps) process.numerator.push_back(fit.coefficients[1] * lags);
  const double pole = shape.integrating ? 1.0 : shape.pole;
  process.denominator = {1.0, -(pole + shape.second_pole), pole * shape.second_pole};
  return process;
}

std::string describe(const LoopData& data, const Fit& fit) {
  const ProcessFit process = report_process(data, fit);
  const bool second = process.second_time_constant_s > 0.0;
  std::string text = process.integrating ? "integrator" : second ? "two lags" : "one lag";
  if (process.integrating && second) text += " with a lag";
  text += text::sentence(", gain ", process.gain,
                         process.integrating ? " pv per % and s" : " pv per %");
  if (!process.integrating)
    text += text::sentence(", time constant ", process.time_constant_s, " s");
  if (second) text += text::sentence(" and ", process.second_time_constant_s, " s");
  return text + text::sentence(", delay ", process.delay_s, " s, ") + noise_words(fit);
}

}  // namespace loopscope::core::model
