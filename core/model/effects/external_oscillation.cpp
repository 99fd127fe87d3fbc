#include "core/model/effects/external_oscillation.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "core/model/phrases.hpp"

namespace loopscope::core::model {

void ExternalOscillation::add_columns(const Signals& signals, std::vector<Column>& columns) const {
  const std::size_t n = signals.flow.size();
  Column sine(n);
  Column cosine(n);
  const std::complex<double> turn = std::polar(1.0, 2.0 * std::numbers::pi / period_);
  std::complex<double> phase = 1.0;
  for (std::size_t k = 0; k < n; ++k, phase *= turn) {
    sine[k] = phase.imag();
    cosine[k] = phase.real();
  }
  columns.push_back(std::move(sine));
  columns.push_back(std::move(cosine));
}

std::vector<EffectPtr> ExternalOscillation::neighbours(double scale) const {
  // A line in a few thousand samples is a few tenths of a cycle over the record wide.
  constexpr double kRecord = 4096.0;
  constexpr double kMove = 0.3;  // cycles over the record
  std::vector<EffectPtr> result;
  for (const double move : {-kMove * scale / kRecord, kMove * scale / kRecord}) {
    result.push_back(std::make_shared<ExternalOscillation>(1.0 / (1.0 / period_ + move)));
  }
  return result;
}

std::vector<Parameter> ExternalOscillation::parameters(const LoopData& data,
                                                       std::span<const double> coefficients,
                                                       double) const {
  const double amplitude = std::hypot(coefficients[0], coefficients[1]) * data.pv_scale;
  return {{"period_s", "s", period_ * data.sample_interval_s, {}, {}},
          {"amplitude", "pv", amplitude, {}, {}}};
}

std::string ExternalOscillation::words(std::span<const Parameter> parameters) const {
  return "An oscillation of period " + in_time(parameters[0].value) +
         " reaches the loop from outside, amplitude " + in_digits(parameters[1].value) +
         " in units of pv.";
}

}  // namespace loopscope::core::model
