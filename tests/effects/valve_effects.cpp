#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/effects/curve_fit.hpp"
#include "tests/effects/effects.hpp"

namespace loopscope::tests::effects {
namespace {

/// Slips that a record of a sticking valve has to hold to be called one.
constexpr int kFewestSlips = 20;

Actuator draw_actuator(const Draft& draft, Random& random) {
  return {random.log_uniform(0.05, 0.3), draft.base.op0};
}

Friction draw_friction(Random& random, double most) {
  const double band = random.log_uniform(1.0, most);
  const double jump = band * random.uniform(0.2, 1.0);
  return generators::friction_of(band, jump);
}

/// Times at which a stem that stood moves off.
int slips(const Series& series) {
  int count = 0;
  bool moved = true;
  for (std::size_t i = 1; i < series.mv.size(); ++i) {
    const bool moves = std::abs(series.mv[i] - series.mv[i - 1]) > 1e-3;
    count += moves && !moved ? 1 : 0;
    moved = moves;
  }
  return count;
}

/// Share of samples at which `values` exceeds `limit`.
double share_above(const std::vector<double>& values, double limit) {
  const auto count =
      std::count_if(values.begin(), values.end(), [=](double v) { return v > limit; });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

double quantile(std::vector<double> values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

/// Share of samples at which op asks for more than the stop gives.
void require_share_beyond(Draft& draft, double stop, bool above) {
  draft.conditions.push_back([=](const Series& with, const Series&) {
    const double over = share_above(with.op, stop);
    const double share = above ? over : 1.0 - over;
    return share > 0.1 && share < 0.4;
  });
}

Curve equal_percentage(double range, double op0) {
  const double slope = std::log(range) / 100.0;
  return [=](double position) { return std::expm1(slope * (position - op0)) / slope; };
}

/// Quick opening, and the look of a trim that is worn where it throttles most.
Curve quick_opening(double exponent, double op0) {
  const double here = std::pow(op0, exponent);
  const double slope = exponent * here / op0;
  return
      [=](double position) { return (std::pow(std::max(position, 0.0), exponent) - here) / slope; };
}

}  // namespace

void add_stiction(Draft& draft, Random& random) {
  const Friction friction = draw_friction(random, 8.0);
  const Actuator actuator = draw_actuator(draft, random);
  const bool karnopp = random.chance(0.5);
  const double response =
      random.chance(0.25) ? random.uniform(0.4, 1.0) : random.log_uniform(0.03, 0.2);
  draft.scenario.valve = [=] {
    return karnopp ? make_karnopp_valve(friction, actuator, response)
                   : make_he_valve(friction, actuator);
  };
  const double band = friction.static_friction + friction.kinetic_friction;
  const double jump = friction.static_friction - friction.kinetic_friction;
  draft.effects.push_back(
      {"valve_stiction", {{"S", "%", band}, {"J", "%", jump}}, karnopp ? "karnopp" : "he"});
  require_visible(draft, 0.3);
  draft.conditions.push_back(
      [](const Series& with, const Series&) { return slips(with) >= kFewestSlips; });
}

void add_deadband(Draft& draft, Random& random) {
  const double width = random.log_uniform(1.0, 6.0);
  const Actuator actuator = draw_actuator(draft, random);
  const double response = random.log_uniform(0.03, 0.3);
  draft.scenario.valve = [=] { return make_backlash_valve(width, actuator, response); };
  draft.effects.push_back({"valve_deadband", {{"width", "%", width}}, "backlash"});
  require_visible(draft, 0.2);
}

void add_saturation(Draft& draft, Random& random) {
  const std::vector<double> op = simulate(draft.base).op;
  const bool above = random.chance(0.6);
  const double share = random.uniform(0.03, 0.3);
  const double stop = quantile(op, above ? 1.0 - share : share);
  const double low = above ? 0.0 : stop;
  const double high = above ? stop : 100.0;
  const Actuator actuator = draw_actuator(draft, random);
  draft.scenario.valve = [=] { return make_stop_valve(low, high, actuator); };
  draft.effects.push_back({"valve_saturation", {{above ? "high" : "low", "%", stop}}, "soft stop"});
  require_share_beyond(draft, stop, above);
  require_visible(draft, 0.1);
}

void add_characteristic(Draft& draft, Random& random) {
  const bool equal = random.chance(0.6);
  const double op0 = draft.base.op0;
  draft.scenario.trim = equal ? equal_percentage(random.uniform(10.0, 50.0), op0)
                              : quick_opening(random.uniform(0.3, 0.55), op0);
  draw_moves(draft, random);
  draft.base.sp = draft.scenario.sp;
  const Curve trim = draft.scenario.trim;
  draft.effects.push_back(
      {"valve_characteristic", {}, equal ? "equal percentage" : "quick opening"});
  const std::size_t place = draft.effects.size() - 1;
  require_visible(draft, kLeastBend);
  draft.conditions.push_back([trim](const Series& with, const Series&) {
    return travel(with.mv) >= 20.0 && gain_ratio(trim, with.mv) >= 1.5;
  });
  draft.measurements.push_back([trim, place](Draft& done, const Series& with) {
    done.effects[place].parameters = {{"curvature", "", centred_curvature(trim, with.mv)},
                                      {"gain_ratio", "", gain_ratio(trim, with.mv)}};
  });
}

void add_intermittent_stiction(Draft& draft, Random& random) {
  const Friction friction = draw_friction(random, 8.0);
  const Actuator actuator = draw_actuator(draft, random);
  std::vector<double> switches;
  for (double time = 0.0; time < static_cast<double>(kRunIn + kSamples);)
    switches.push_back(time += random.uniform(150.0, 700.0));
  draft.scenario.valve = [=] { return make_intermittent_valve(friction, actuator, switches); };
  require_visible(draft, 0.3);
}

void add_hunting_positioner(Draft& draft, Random& random) {
  const double amplitude = random.log_uniform(0.5, 4.0);
  const double period = random.log_uniform(5.0, 20.0);
  const Actuator actuator = draw_actuator(draft, random);
  draft.scenario.valve = [=] { return make_hunting_valve(amplitude, period, actuator); };
  require_visible(draft, 0.15);
}

}  // namespace loopscope::tests::effects
