#include <algorithm>
#include <cmath>

#include "tests/effects/draft.hpp"
#include "tests/generators/simc.hpp"
#include "tests/generators/values.hpp"

namespace loopscope::tests::effects {
namespace {

using generators::standard_deviation;

Process draw_process(const LoopOptions& options, Random& random) {
  Process process;
  process.gain = random.log_uniform(0.3, 3.0) * (random.chance(0.2) ? -1.0 : 1.0);
  process.delay = random.whole(1, 9) + 0.05 * random.whole(2, 18);
  process.integrating = options.only_integrates || (options.may_integrate && random.chance(0.2));
  // A vessel is described by the samples in which it fills, an order above the lags.
  process.tau = process.integrating ? random.log_uniform(10.0, 200.0)
                                    : random.log_uniform(2.0, options.most_tau);
  if (random.chance(0.4)) process.second_tau = process.tau * random.uniform(0.1, 0.7);
  if (process.integrating) process.second_tau = std::min(process.second_tau, 10.0);
  return process;
}

/// SIMC (Skogestad 2003); half a sample of delay for the held op. `speed` = desired closed-loop
/// time constant by the process's own.
Controller simc(const Process& process, double speed) {
  const double delay = process.delay + 0.5 + process.second_tau / 2.0;
  if (process.integrating) {
    const double closed = speed * (2.0 * delay + 5.0);
    // Level controllers of real plants stay below 4 % per %.
    const double kc = std::min(process.tau / (closed + delay), 4.0 / std::abs(process.gain)) /
                      std::abs(process.gain);
    const double ti = 4.0 * process.tau / (kc * std::abs(process.gain));
    return {std::copysign(kc, process.gain), ti};
  }
  const double tau = process.tau + process.second_tau / 2.0;
  const double closed = speed * (tau + delay);
  const auto [kc, ti] = generators::simc_of_lag(process.gain, tau, closed + delay);
  return {kc, ti};
}

/// Scales kc down until the loop is as robust as asked.
Controller with_peak_below(const LoopFrequency& loop, Controller controller, double peak) {
  for (int i = 0;
       i < 60 && (loop.gain_margin(controller) < 1.5 || loop.peak_sensitivity(controller) > peak);
       ++i)
    controller.kc *= 0.9;
  return controller;
}

Controller tight(const LoopFrequency& loop, Controller controller, Random& random) {
  if (random.chance(0.5)) controller.ti = std::max(1.0, controller.ti / random.uniform(1.5, 4.0));
  controller.kc *= loop.gain_margin(controller) / random.uniform(1.1, 1.35);
  return controller;
}

Controller sluggish(Controller controller, Random& random) {
  controller.kc *= random.log_uniform(0.04, 0.15);
  controller.ti *= random.uniform(1.0, 2.0);
  return controller;
}

Controller draw_controller(const Draft& draft, Random& random) {
  const Process& process = draft.base.process;
  const LoopFrequency loop(process);
  switch (draft.options.tuning) {
    case Tuning::tight:
      return tight(loop, simc(process, random.uniform(0.7, 1.5)), random);
    case Tuning::sluggish:
      return sluggish(with_peak_below(loop, simc(process, 1.0), 1.8), random);
    case Tuning::robust:
      return with_peak_below(loop, simc(process, random.log_uniform(0.7, 2.0)), 1.4);
    case Tuning::firm:
      return with_peak_below(loop, simc(process, random.log_uniform(0.5, 1.2)), 2.0);
    case Tuning::normal:
      break;
  }
  return with_peak_below(loop, simc(process, random.log_uniform(0.3, 1.8)), 1.9);
}

LoadModel draw_load(const Draft& draft, Random& random) {
  const bool slow = draft.options.tuning == Tuning::sluggish;
  const double memory =
      random.chance(0.3) ? 1.0 : 1.0 - random.log_uniform(0.001, slow ? 0.01 : 0.1);
  const Process& process = draft.base.process;
  if (draft.options.load_at_output || random.chance(0.5)) return output_load_model(memory);
  return input_load_model(memory,
                          {process.integrating, process.gain, process.tau, process.second_tau});
}

/// Load and white noise, of such a size that pv's standard deviation is as drawn.
void draw_noise(Draft& draft, Random& random) {
  Scenario& base = draft.base;
  base.noise_seed = random.next();
  base.load = draw_load(draft, random);
  const double load_std = standard_deviation(simulate(base).pv);
  base.load.scale /= load_std;
  base.noise_sd = std::sqrt(random.log_uniform(0.02, 1.0));
  draft.noise_std = random.log_uniform(draft.options.noise.low, draft.options.noise.high) *
                    draft.options.noise_factor;
  const double factor = draft.noise_std / standard_deviation(simulate(base).pv);
  base.load.scale *= factor;
  base.noise_sd *= factor;
}

}  // namespace

Draft draw_loop(const LoopOptions& options, Random& random) {
  Draft draft;
  draft.options = options;
  draft.base.op0 = random.uniform(30.0, 70.0);
  draft.base.pv0 = random.uniform(30.0, 70.0);
  draft.base.sp.assign(kRunIn + kSamples, 0.0);
  draft.base.process = draw_process(options, random);
  draft.base.controller = draw_controller(draft, random);
  draw_noise(draft, random);
  draft.scenario = draft.base;
  draw_moves(draft, random);
  draft.base.sp = draft.scenario.sp;
  return draft;
}

}  // namespace loopscope::tests::effects
