#include "core/model/effects/valve.hpp"

#include <algorithm>
#include <cctype>

#include "core/text/phrases.hpp"

namespace loopscope::core::model {

EffectKind ValveEffect::kind() const {
  const bool play = valve_.slip_jump_percent < kPlay * valve_.stickband_percent;
  return play ? EffectKind::valve_deadband : EffectKind::valve_stiction;
}

void ValveEffect::shape_flow(std::span<double> flow) const {
  const std::vector<double> op(flow.begin(), flow.end());
  run_valve(valve_, op, flow);
}

ValveEffect ValveEffect::coming(double direction) const {
  Valve valve = valve_;
  valve.start_direction = direction;
  valve.start_percent.reset();
  return ValveEffect(valve);
}

EffectPtr ValveEffect::with_band(double times, double jump_share) const {
  Valve valve = valve_;
  valve.stickband_percent *= times;
  valve.slip_jump_percent = std::clamp(jump_share, 0.0, 1.0) * valve.stickband_percent;
  return std::make_shared<ValveEffect>(valve);
}

/// What passes between the samples, and where the stem began: it is long remembered.
void ValveEffect::add_between_samples(double scale, std::vector<EffectPtr>& neighbours) const {
  for (const double move : {-0.25 * scale, 0.25 * scale}) {
    Valve valve = valve_;
    valve.between.actuator_lag_samples *= 1.0 + move;
    neighbours.push_back(std::make_shared<ValveEffect>(valve));
    if (valve_.start_percent) {
      valve = valve_;
      *valve.start_percent += move * valve_.slip_jump_percent;
      neighbours.push_back(std::make_shared<ValveEffect>(valve));
    }
    if (valve_.between.stem_lag_samples <= 0.0) continue;
    valve = valve_;
    valve.between.stem_lag_samples *= 1.0 + move;
    neighbours.push_back(std::make_shared<ValveEffect>(valve));
  }
}

std::vector<EffectPtr> ValveEffect::neighbours(double scale) const {
  std::vector<EffectPtr> result;
  const auto add = [&](double band, double jump) {
    Valve valve = valve_;
    valve.stickband_percent = band;
    valve.slip_jump_percent = std::clamp(jump, 0.0, band);
    result.push_back(std::make_shared<ValveEffect>(valve));
  };
  const double band = valve_.stickband_percent;
  const double jump = valve_.slip_jump_percent;
  for (const double move : {-0.02 * scale, 0.02 * scale}) add(band * (1.0 + move), jump);
  for (const double move : {-0.3 * scale, 0.3 * scale}) {
    add(band, jump + move * band);
    // Where the valve moves with op it lags by (S - J) / 2: along this line that stays as it is.
    add(band * (1.0 + move / 15.0), jump + band * move / 15.0);
  }
  if (!valve_.acts_at_samples()) add_between_samples(scale, result);
  return result;
}

std::vector<Parameter> ValveEffect::parameters(const LoopData&, std::span<const double>,
                                               double) const {
  if (kind() == EffectKind::valve_deadband)
    return {{"width", "%", valve_.stickband_percent, {}, {}}};
  return {{"S", "%", valve_.stickband_percent, {}, {}},
          {"J", "%", valve_.slip_jump_percent, {}, {}}};
}

std::string_view ValveEffect::law() const {
  return kind() == EffectKind::valve_stiction ? name(valve_.law) : std::string_view();
}

namespace {

/// "kano" as a name.
std::string author(std::string_view law) {
  std::string name(law);
  if (!name.empty()) name.front() = static_cast<char>(std::toupper(name.front()));
  return name;
}

}  // namespace

std::string ValveEffect::words(std::span<const Parameter> parameters) const {
  if (kind() == EffectKind::valve_deadband) {
    return "The valve has " + text::number(parameters[0].value) +
           " % of dead band (backlash): after each reversal the controller output moves that far "
           "before the valve follows.";
  }
  return "The valve sticks: after a reversal it stands still until the controller output has "
         "moved " +
         text::number(parameters[0].value) + " %, then jumps by " +
         text::number(parameters[1].value) + " % (stiction model of " + author(law()) + ").";
}

}  // namespace loopscope::core::model
