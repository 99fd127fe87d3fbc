#include <cmath>

#include "tests/effects/effects.hpp"

namespace loopscope::tests::effects {

void add_quantisation(Draft& draft, Random& random) {
  const Scenario& base = draft.base;
  const double unforeseen = predictor(base.load, base.noise_sd * base.noise_sd, 1).variance;
  const double step = std::sqrt(unforeseen) * random.log_uniform(0.5, 2.0);
  draft.scenario.quantum = step;
  draft.effects.push_back({"sensor_quantisation", {{"step", "pv", step}}, "rounding"});
}

void add_hold(Draft& draft, Random& random) {
  draft.scenario.hold = random.whole(4, 15);
  draft.effects.push_back({"sensor_hold",
                           {{"samples", "samples", static_cast<double>(draft.scenario.hold)}},
                           "renewed"});
}

void add_sensor_drift(Draft& draft, Random& random) {
  const double size = draft.noise_std * random.uniform(4.0, 10.0) * random.sign();
  const double start = random.uniform(300.0, 2500.0);
  const double drift = random.uniform(100.0, 800.0);
  const double stay = random.uniform(50.0, 500.0);
  draft.scenario.sensor_bias = [=](double time) {
    if (time < start || time > start + drift + stay) return 0.0;
    return size * std::fmin(1.0, (time - start) / drift);
  };
}

}  // namespace loopscope::tests::effects
