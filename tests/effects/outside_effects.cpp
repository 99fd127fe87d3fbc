#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "tests/effects/effects.hpp"

namespace loopscope::tests::effects {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

TimeFunction sum_of(const TimeFunction& first, const TimeFunction& second) {
  if (!first) return second;
  return [=](double time) { return first(time) + second(time); };
}

/// A phase that wanders by `jitter` radians (standard deviation) a period, linear between samples.
TimeFunction wandering_phase(double period, double jitter, Random& random) {
  auto phase = std::make_shared<std::vector<double>>();
  double value = random.uniform(0.0, kTwoPi);
  const double step = jitter / std::sqrt(period);
  for (std::size_t k = 0; k <= kRunIn + kSamples + 1; ++k) {
    phase->push_back(value);
    value += step * random.normal();
  }
  return [phase](double time) {
    // Behind its end the course goes on as it began.
    const auto cycle = static_cast<double>(phase->size() - 1);
    const double place = std::max(0.0, time + static_cast<double>(kRunIn));
    const double turns = std::floor(place / cycle);
    const auto k = static_cast<std::size_t>(place - turns * cycle);
    const double part = place - turns * cycle - static_cast<double>(k);
    return turns * (phase->back() - phase->front()) + (*phase)[k] +
           part * ((*phase)[k + 1] - (*phase)[k]);
  };
}

/// A period at which the loop lets enough through to be seen.
double draw_period(const Draft& draft, const LoopFrequency& loop, Random& random) {
  constexpr double kSeen = 0.35;
  double period = 0.0;
  for (int i = 0; i < 40; ++i) {
    period = random.log_uniform(15.0, 400.0);
    if (loop.sensitivity(draft.base.controller, kTwoPi / period) > kSeen) break;
  }
  return period;
}

/// Rises slowly and falls fast, each cycle of another length and height; then through a lag.
TimeFunction relaxation(double period, double amplitude, Random& random) {
  const double rise = random.uniform(0.65, 0.92);
  const double lag = period * random.uniform(0.02, 0.08);
  auto values = std::make_shared<std::vector<double>>();
  double filtered = 0.0;
  while (values->size() < kRunIn + kSamples + 2) {
    const double length = period * (1.0 + 0.12 * random.normal());
    const double height = amplitude * (1.0 + 0.2 * random.normal());
    for (double time = 0.0; time < length; time += 1.0) {
      const double part = time / std::max(length, 2.0);
      const double raw =
          part < rise ? 2.0 * part / rise - 1.0 : 1.0 - 2.0 * (part - rise) / (1.0 - rise);
      filtered += (height * raw - filtered) / (1.0 + lag);
      values->push_back(filtered);
    }
  }
  return [values](double time) {
    const auto place = static_cast<std::size_t>(std::max(0.0, time + static_cast<double>(kRunIn)));
    return (*values)[place % values->size()];
  };
}

}  // namespace

void require_visible(Draft& draft, double share) {
  const double least = share * draft.noise_std * draft.noise_std;
  draft.conditions.push_back([=](const Series& with, const Series& without) {
    double sum = 0.0;
    for (std::size_t i = 0; i < with.pv.size(); ++i)
      sum += (with.pv[i] - without.pv[i]) * (with.pv[i] - without.pv[i]);
    return sum / static_cast<double>(with.pv.size()) >= least;
  });
}

void add_oscillation(Draft& draft, Random& random) {
  const LoopFrequency loop(draft.base.process);
  const double period = draw_period(draft, loop, random);
  const double amplitude = draft.noise_std * random.uniform(1.0, 4.0);
  const bool at_input = !draft.options.load_at_output && random.chance(0.4);
  const double raw = at_input ? amplitude / loop.process_gain(kTwoPi / period) : amplitude;
  const double second = random.chance(0.3) ? random.uniform(0.1, 0.35) : 0.0;
  const double jitter = random.chance(0.4) ? random.log_uniform(0.02, 0.15) : 0.0;
  const TimeFunction phase = wandering_phase(period, jitter, random);
  const TimeFunction wave = [=](double time) {
    const double angle = kTwoPi * time / period + phase(time);
    return raw * (std::sin(angle) + second * std::sin(2.0 * angle + 1.0));
  };
  TimeFunction& place = at_input ? draft.scenario.input_load : draft.scenario.output_load;
  place = sum_of(place, wave);
  draft.effects.push_back({"external_oscillation",
                           {{"period_s", "s", period}, {"amplitude", "pv", amplitude}},
                           at_input ? "at the input" : "at the output"});
}

void add_load_steps(Draft& draft, Random& random) {
  const int count = random.whole(1, 3);
  for (int i = 0; i < count; ++i) {
    const double at = kEnd * (i + random.uniform(0.25, 0.75)) / count;
    const double size = draft.noise_std * random.log_uniform(4.0, 15.0) * random.sign();
    const double lag = random.log_uniform(0.3, 10.0);
    const TimeFunction step = [=](double time) {
      return time < at ? 0.0 : size * -std::expm1(-(time - at) / lag);
    };
    draft.scenario.output_load = sum_of(draft.scenario.output_load, step);
    draft.effects.push_back(
        {"load_step", {{"at", "s", at}, {"size", "pv", size}}, "through a lag"});
  }
}

void add_nonlinear_neighbour(Draft& draft, Random& random) {
  const LoopFrequency loop(draft.base.process);
  const double period = draw_period(draft, loop, random);
  const double amplitude = draft.noise_std * random.uniform(1.5, 5.0);
  draft.scenario.output_load = relaxation(period, amplitude, random);
  require_visible(draft, 0.2);
}

}  // namespace loopscope::tests::effects
