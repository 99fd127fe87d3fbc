#include <algorithm>
#include <cmath>

#include "tests/effects/curve_fit.hpp"
#include "tests/effects/effects.hpp"

namespace loopscope::tests::effects {
namespace {

/// Square-root outflow; the loop's gain and time constant hold at pv0.
void make_tank(Draft& draft) {
  Process& process = draft.scenario.process;
  process.integrating = true;
  process.gain = std::abs(process.gain);
  const double level = draft.base.pv0;
  const double gain = process.gain;
  process.loss = [=](double rise) {
    return 2.0 * (std::sqrt(level * std::max(0.0, level + rise)) - level) / gain;
  };
  draft.base.process.gain = gain;
  draft.base.controller.kc = draft.scenario.controller.kc = std::abs(draft.base.controller.kc);
}

/// The gain dies away on one side and grows on the other, as conversion does.
Curve exponential(double scale) {
  return [=](double x) { return scale * -std::expm1(-x / scale); };
}

/// Steep about `centre`, flat on both sides, as pH is; slope 1 at 0.
Curve titration(double scale, double centre) {
  const double here = std::tanh(centre / scale);
  const double slope = 1.0 - here * here;
  return [=](double x) { return scale * (std::tanh((x - centre) / scale) + here) / slope; };
}

/// The law by name; `reach` = pv that the moves of op would travel without the bend.
std::string bend(Draft& draft, Random& random) {
  const double reach = std::abs(draft.base.process.gain) * draft.options.op_range / 2.0;
  Process& process = draft.scenario.process;
  const double law = random.uniform(0.0, 1.0);
  if (law < 0.4) {
    make_tank(draft);
    return "tank";
  }
  if (law < 0.7) {
    process.output_curve = exponential(random.sign() * reach * random.uniform(1.2, 2.5));
    return "exponential";
  }
  const double scale = reach * random.uniform(1.0, 1.8);
  process.output_curve = titration(scale, random.sign() * scale * random.uniform(0.4, 0.9));
  return "titration";
}

/// Resting pv over the straight pv, whatever the law.
Curve static_curve(const Scenario& scenario) {
  return [scenario](double straight) {
    return resting_pv(scenario, scenario.op0 + straight / scenario.process.gain);
  };
}

/// The straight pv that belongs to each op.
std::vector<double> straight_pv(const Scenario& scenario, const std::vector<double>& op) {
  std::vector<double> straight;
  for (const double value : op) straight.push_back(scenario.process.gain * (value - scenario.op0));
  return straight;
}

}  // namespace

void add_process_nonlinearity(Draft& draft, Random& random) {
  const std::string law = bend(draft, random);
  draw_moves(draft, random);
  draft.base.sp = draft.scenario.sp;
  draft.effects.push_back({"process_nonlinearity", {}, law});
  const std::size_t place = draft.effects.size() - 1;
  require_visible(draft, kLeastBend);
  const Scenario scenario = draft.scenario;
  draft.conditions.push_back([scenario](const Series& with, const Series&) {
    return travel(with.mv) >= 15.0 &&
           gain_ratio(static_curve(scenario), straight_pv(scenario, with.mv)) >= 1.5;
  });
  draft.measurements.push_back([place, scenario](Draft& done, const Series& with) {
    const Curve curve = static_curve(scenario);
    const std::vector<double> straight = straight_pv(scenario, with.mv);
    done.effects[place].parameters = {{"curvature", "", centred_curvature(curve, straight)},
                                      {"gain_ratio", "", gain_ratio(curve, straight)}};
  });
}

void add_gain_change(Draft& draft, Random& random) {
  const double ratio = random.chance(0.5) ? random.uniform(0.4, 0.7) : random.log_uniform(1.4, 2.5);
  require_visible(draft, kLeastBend);
  if (random.chance(0.6)) {
    const double at = random.uniform(0.2, 0.8) * kEnd;
    draft.scenario.process_gain = [=](double time) { return time < at ? 1.0 : ratio; };
    draft.effects.push_back({"gain_change", {{"at", "s", at}, {"ratio", "", ratio}}, "sudden"});
    return;
  }
  draft.scenario.process_gain = [=](double time) {
    return 1.0 + (ratio - 1.0) * std::clamp(time / kEnd, 0.0, 1.0);
  };
  // Per sample; the record turns it into a rate per hour.
  draft.effects.push_back(
      {"gain_change", {{"rate", "1/h", (ratio - 1.0) / kEnd}, {"ratio", "", ratio}}, "ramp"});
}

void add_delay_change(Draft& draft, Random& random) {
  const double before = draft.base.process.delay;
  const double after = before + random.uniform(3.0, 9.0);
  if (random.chance(0.5)) {
    const double at = random.uniform(0.25, 0.75) * kEnd;
    draft.scenario.delay = [=](double time) { return time < at ? before : after; };
  } else {
    const double period = random.uniform(500.0, 2000.0);
    draft.scenario.delay = [=](double time) {
      return before + (after - before) * (0.5 - 0.5 * std::cos(2.0 * M_PI * time / period));
    };
  }
  require_visible(draft, 0.02);
}

void add_controller_change(Draft& draft, Random& random) {
  const double factor = random.chance(0.5) ? random.uniform(0.15, 0.4) : random.uniform(1.5, 2.0);
  const double at = random.uniform(0.25, 0.75) * kEnd;
  draft.scenario.controller_gain = [=](double time) { return time < at ? 1.0 : factor; };
}

void add_overflow_weir(Draft& draft, Random& random) {
  Process& process = draft.scenario.process;
  process.gain = draft.base.process.gain = std::abs(process.gain);
  draft.base.controller.kc = draft.scenario.controller.kc = std::abs(draft.base.controller.kc);
  // A weir works over a part of the levels that are run, or of those that the load gives.
  const double highest = *std::max_element(draft.base.sp.begin(), draft.base.sp.end());
  const double rise = std::max(draft.noise_std, highest / 2.0);
  const double crest = rise * random.uniform(0.0, 0.8);
  const double strength = random.uniform(5.0, 20.0) / std::pow(rise, 1.5);
  process.loss = [=](double level) {
    return level > crest ? strength * std::pow(level - crest, 1.5) : 0.0;
  };
  require_visible(draft, 0.2);
}

}  // namespace loopscope::tests::effects
