#include "tests/core/model/tuning_cases.hpp"

#include <cmath>
#include <numeric>
#include <random>

#include "core/model/controller/closed_loop.hpp"
#include "core/model/controller/simc.hpp"
#include "tests/core/model/known_loops.hpp"

namespace loopscope::core::model::known {
namespace {

using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
  return low + (high - low) * std::uniform_real_distribution<double>()(random);
}

double log_between(Random& random, double low, double high) {
  return std::exp(between(random, std::log(low), std::log(high)));
}

ProcessFit random_process(Random& random, std::size_t kind) {
  ProcessFit fit;
  fit.delay_s = std::floor(between(random, 1.0, 11.0));
  fit.gain = log_between(random, 0.14, 7.4);
  fit.integrating = kind == 2;
  if (fit.integrating) fit.gain *= 0.05;
  if (!fit.integrating) fit.time_constant_s = log_between(random, 1.0, 60.0);
  if (kind == 1) fit.second_time_constant_s = fit.time_constant_s * between(random, 0.1, 0.9);
  return fit;
}

ControllerLaw random_law(Random& random, const ProcessFit& fit) {
  const ControllerLaw simc = simc_law(fit, 1.0);
  const double gain = log_between(random, 0.05, 6.0);
  const double integral = gain * log_between(random, 0.4, 2.5) * (fit.integrating ? gain : 1.0);
  return law(simc.gain * gain, simc.integral * integral);
}

/// Integral of the absolute error after a step of the load (of an integrating process at its
/// input, else at its output), by running the loop.
double error_after_load(const ProcessFit& fit, const ControllerLaw& law) {
  constexpr std::size_t kSamples = 6000;
  const SampledProcess process = sample_process(fit, 1.0);
  const double at_input = fit.integrating ? 1.0 : 0.0;
  Series answer(kSamples), op(kSamples), error(kSamples);
  double sum = 0.0;
  for (std::size_t k = 0; k < kSamples; ++k) {
    for (std::size_t j = 1; j < process.denominator.size() && j <= k; ++j) {
      answer[k] -= process.denominator[j] * answer[k - j];
    }
    for (std::size_t j = 0; j < process.numerator.size(); ++j) {
      const std::size_t back = process.delay_samples + j;
      if (k >= back) answer[k] += process.numerator[j] * (op[k - back] + at_input);
    }
    error[k] = -(answer[k] + 1.0 - at_input);
    const double before = k > 0 ? error[k - 1] : 0.0;
    op[k] = (k > 0 ? op[k - 1] : 0.0) + law.gain * (error[k] - before) + law.integral * error[k];
    sum += std::abs(error[k]);
  }
  return sum;
}

}  // namespace

std::size_t TuningCounts::total() const {
  return std::accumulate(judged.begin(), judged.end(), std::size_t{0});
}

double TuningCounts::share(Tuning tuning) const {
  return static_cast<double>(judged[static_cast<std::size_t>(tuning)]) /
         static_cast<double>(total());
}

TuningRates tuning_rates(std::size_t loops) {
  TuningRates rates;
  Random random(1);
  for (std::size_t i = 0; i < loops; ++i) {
    const ProcessFit fit = random_process(random, i % 3);
    const ControllerLaw law = random_law(random, fit);
    const auto judged =
        static_cast<std::size_t>(judge_tuning(off_by_a_fifth(fit, i), law, 1.0).tuning);
    const double sensitivity = close_loop(fit, law, 1.0).peak_sensitivity;
    ControllerLaw weaker = law;
    weaker.gain *= 0.8;
    weaker.integral *= 0.8;
    // A loop far beyond stability is not met in a plant.
    const bool met = std::isfinite(close_loop(fit, weaker, 1.0).peak_sensitivity);
    if (sensitivity > 3.5) rates.tight.judged[judged] += met ? 1 : 0;
    if (sensitivity > 2.0) continue;
    const double slower = error_after_load(fit, law) / error_after_load(fit, simc_law(fit, 1.0));
    if (slower < 2.5) ++rates.fine.judged[judged];
    if (slower > 5.0 && sensitivity < 1.8) {
      ++(fit.integrating ? rates.averaging : rates.sluggish).judged[judged];
    }
  }
  return rates;
}

}  // namespace loopscope::core::model::known
