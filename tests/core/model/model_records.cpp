#include "tests/core/model/model_records.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "core/model/effects/valve.hpp"
#include "core/model/fit/trial.hpp"
#include "core/simulate/random.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model::tests {

Series stepping_op(std::size_t samples, std::uint64_t seed, double size) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Series op;
  while (op.size() < samples) {
    const double level = 50.0 + size * (2.0 * uniform(engine) - 1.0);
    const auto rest = static_cast<std::size_t>(5.0 + 40.0 * uniform(engine));
    op.insert(op.end(), std::min(rest, samples - op.size()), level);
  }
  return op;
}

Series white_noise(std::size_t samples, std::uint64_t seed, double deviation) {
  simulate::GaussianSource source(seed);
  Series noise(samples);
  for (double& value : noise) value = deviation * source.next();
  return noise;
}

Series sine(std::size_t samples, double period, double noise) {
  simulate::GaussianSource source(7);
  Series signal(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    signal[k] =
        std::sin(loopscope::tests::kTurn * static_cast<double>(k) / period) + noise * source.next();
  }
  return signal;
}

Series triangle(std::size_t samples, std::size_t half) {
  Series signal(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    const std::size_t phase = k % (2 * half);
    signal[k] = static_cast<double>(phase < half ? phase : 2 * half - phase);
  }
  return signal;
}

Series coloured_noise(const NoiseModel& noise, std::size_t samples, std::uint64_t seed,
                      double deviation) {
  Series series = white_noise(samples, seed, deviation);
  const Series white = series;
  for (std::size_t k = 0; k < samples; ++k) {
    for (std::size_t i = 0; i < noise.order && i < k; ++i) {
      series[k] += noise.zeros[i] * white[k - i - 1];
    }
  }
  for (std::size_t i = 0; i < noise.order; ++i) {
    double state = 0.0;
    for (double& value : series) value = state = noise.poles[i] * state + value;
  }
  return series;
}

Series sum(const Series& left, const Series& right) {
  Series result(left.size());
  std::ranges::transform(left, right, result.begin(), std::plus<>());
  return result;
}

Series scaled(Series series, double factor) {
  for (double& value : series) value *= factor;
  return series;
}

double mean(const Series& series) {
  return std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
}

Series process_record(const ProcessShape& shape, double gain, const Series& op,
                      const Series& noise) {
  Series input = op;
  for (double& value : input) value -= 50.0;
  Series pv = sum(scaled(answer(shape, input), gain), noise);
  for (double& value : pv) value += 50.0;
  return pv;
}

Series held(Series series, std::size_t samples, std::size_t first) {
  for (std::size_t k = 1; k < series.size(); ++k) {
    if (k < first || (k - first) % samples != 0) series[k] = series[k - 1];
  }
  return series;
}

ProcessShape one_lag(double pole, std::size_t delay_samples) {
  return {.delay_samples = delay_samples, .integrating = false, .pole = pole};
}

ProcessShape two_lags(double pole, double second_pole, std::size_t delay_samples) {
  return {.delay_samples = delay_samples,
          .integrating = false,
          .pole = pole,
          .second_pole = second_pole};
}

ProcessShape integrator(std::size_t delay_samples) {
  return {.delay_samples = delay_samples, .integrating = true, .pole = 1.0};
}

Structure structure_of(const ProcessShape& shape, std::vector<EffectPtr> effects) {
  Structure structure;
  structure.process = shape;
  structure.noise = {1, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  structure.second_order = shape.second_pole != 0.0;
  structure.two_taps = shape.numerator[1] != 0.0;
  structure.effects = std::move(effects);
  return structure;
}

simulate::LoopRecord noiseless_loop(const simulate::Effect& effect, double move) {
  simulate::LoopSettings loop = simulate::scenario_loop("healthy_flow");
  loop.load.step_std = 0.0;
  loop.measurement_noise_std = 0.0;
  loop.effects = {effect};
  const double pattern[] = {1.0, -1.0, -1.0, 1.0};
  const std::size_t end = loop.discarded_samples + loop.recorded_samples;
  for (std::size_t at = 97; at < end; at += 97) {
    loop.setpoint_moves.push_back(
        {.at_sample = at, .size = move * pattern[loop.setpoint_moves.size() % 4]});
  }
  return simulate::simulate_loop(loop, 1);
}

ProcessShape noiseless_process() {
  return one_lag(0.6, 2);
}

Fit fit_noiseless(const LoopData& data, EffectPtr effect) {
  return evaluate(data, structure_of(noiseless_process(), {std::move(effect)}));
}

Series last_coefficients(const Fit& fit) {
  std::size_t first = fit.taps();
  const auto& effects = fit.structure.effects;
  for (std::size_t i = 0; i + 1 < effects.size(); ++i) first += effects[i]->column_count();
  const auto begin = fit.coefficients.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(effects.back()->column_count())};
}

std::vector<Parameter> last_parameters(const LoopData& data, const Fit& fit) {
  return fit.structure.effects.back()->parameters(data, last_coefficients(fit), fit.gain());
}

double value_of(const std::vector<Parameter>& parameters, std::string_view name) {
  const auto found = std::ranges::find(parameters, name, &Parameter::name);
  return found == parameters.end() ? std::numeric_limits<double>::quiet_NaN() : found->value;
}

const Valve& valve_of(const GridResult& find) {
  return dynamic_cast<const ValveEffect&>(*find.structure.effects.back()).valve();
}

simulate::LoopRecord scenario_record(std::string_view name, std::uint64_t seed) {
  return simulate::simulate_scenario(name, {}, seed);
}

std::optional<Explanation> explain_record(const simulate::LoopRecord& record, std::uint64_t seed) {
  const Series error = simulate::control_error(record);
  return explain({record.pv, record.op, record.sp, error, record.sample_interval_s, true, seed});
}

std::optional<Explanation> explain_scenario(std::string_view name, std::uint64_t seed) {
  return explain_record(scenario_record(name, seed), seed);
}

bool claims_hardware(const Explanation& explanation) {
  return explanation.excited && std::ranges::any_of(explanation.steps, [](const Step& step) {
           return step.effect != EffectKind::load_step &&
                  step.effect != EffectKind::external_oscillation;
         });
}

}  // namespace loopscope::core::model::tests
