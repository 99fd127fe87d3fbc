#include "core/model/residual_tests/run_residual_tests.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/record/op_direction.hpp"
#include "core/model/residual_tests/tests/coupling.hpp"

namespace loopscope::core::model {
namespace {

/// The one-step errors of every recorded sample behind the warm-up, pv units; NaN elsewhere.
std::vector<double> residual_of(const LoopData& data, const Fit& fit) {
  std::vector<double> residual(data.size(), std::nan(""));
  for (const auto* rows : {&data.rows.fit, &data.rows.score, &data.rows.guard}) {
    for (const Range& range : *rows) {
      for (std::size_t k = range.first; k < range.end; ++k)
        residual[k] = fit.innovations[k] * data.pv_scale;
    }
  }
  return residual;
}

/// pv less what the model says comes from outside, pv units; empty where it says nothing. A wave
/// that the model has would else be asked for again: op may explain its line in the residual, so
/// that it is sought in pv.
std::vector<double> undisturbed_pv(const ModelInput& input, const LoopData& data, const Fit& fit) {
  Fit outside = fit;
  std::ranges::fill(outside.coefficients, 0.0);
  const auto& effects = fit.structure.effects;
  std::size_t at = fit.taps();
  for (std::size_t place = 0; place < effects.size(); ++place) {
    const std::span<const double> own = coefficients_of(fit, place);
    if (is_from_outside(effects[place]->kind()))
      std::ranges::copy(own, outside.coefficients.begin() + static_cast<std::ptrdiff_t>(at));
    at += own.size();
  }
  if (std::ranges::all_of(outside.coefficients, [](double value) { return value == 0.0; }))
    return {};
  std::vector<double> result = deterministic_output(data, outside);
  std::ranges::transform(input.pv, result, result.begin(),
                         [&](double pv, double wave) { return pv - data.pv_scale * wave; });
  return result;
}

}  // namespace

std::vector<double> response_of(const LoopData& data, const Fit& fit) {
  std::vector<double> response = deterministic_output(data, fit);
  for (double& value : response) value *= data.pv_scale;
  return response;
}

std::vector<TestOutcome> run_residual_tests(const ModelInput& input, const LoopData& data,
                                            const Fit& fit) {
  const std::vector<double> residual = residual_of(data, fit);
  const std::vector<double> direction = op_direction(input.op);
  const std::vector<double> response = response_of(data, fit);
  const std::vector<double> undisturbed = undisturbed_pv(input, data, fit);
  return test_residual(
      {residual, input.op, direction, response, input.pv, input.sample_interval_s, undisturbed});
}

std::vector<TestOutcome> run_coupling_tests(const LoopData& data, const Fit& fit,
                                            std::uint64_t seed) {
  return test_coupling(residual_of(data, fit), seed);
}

}  // namespace loopscope::core::model
