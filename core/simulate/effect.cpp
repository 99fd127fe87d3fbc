#include "core/simulate/effect.hpp"

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <type_traits>

namespace loopscope::core::simulate {

namespace {

/// One numeric parameter of an effect of type E.
template <class E>
struct Field {
  std::string_view name;
  double E::*member;
};

// What every effect is called and which numbers it takes: the one place that names them.
constexpr std::string_view word(const ValveStiction&) {
  return "valve_stiction";
}
constexpr std::string_view word(const ValveDeadband&) {
  return "valve_deadband";
}
constexpr std::string_view word(const ValveSaturation&) {
  return "valve_saturation";
}
constexpr std::string_view word(const ValveCharacteristic&) {
  return "valve_characteristic";
}
constexpr std::string_view word(const GainChange&) {
  return "gain_change";
}
constexpr std::string_view word(const ProcessNonlinearity&) {
  return "process_nonlinearity";
}
constexpr std::string_view word(const ExternalOscillation&) {
  return "external_oscillation";
}
constexpr std::string_view word(const LoadStep&) {
  return "load_step";
}
constexpr std::string_view word(const SensorHold&) {
  return "sensor_hold";
}
constexpr std::string_view word(const SensorQuantisation&) {
  return "sensor_quantisation";
}

std::vector<Field<ValveStiction>> fields(const ValveStiction&) {
  return {{"S", &ValveStiction::stickband_percent}, {"J", &ValveStiction::slip_jump_percent}};
}
std::vector<Field<ValveDeadband>> fields(const ValveDeadband&) {
  return {{"width", &ValveDeadband::width_percent}};
}
std::vector<Field<ValveSaturation>> fields(const ValveSaturation&) {
  return {{"low", &ValveSaturation::low_percent}, {"high", &ValveSaturation::high_percent}};
}
std::vector<Field<ValveCharacteristic>> fields(const ValveCharacteristic&) {
  return {{"curvature", &ValveCharacteristic::curvature}};
}
std::vector<Field<GainChange>> fields(const GainChange&) {
  return {{"at", &GainChange::at_s},
          {"rate", &GainChange::rate_per_hour},
          {"ratio", &GainChange::ratio}};
}
std::vector<Field<ProcessNonlinearity>> fields(const ProcessNonlinearity&) {
  return {{"curvature", &ProcessNonlinearity::curvature}};
}
std::vector<Field<ExternalOscillation>> fields(const ExternalOscillation&) {
  return {{"period_s", &ExternalOscillation::period_s},
          {"amplitude", &ExternalOscillation::amplitude}};
}
std::vector<Field<LoadStep>> fields(const LoadStep&) {
  return {{"at", &LoadStep::at_s}, {"size", &LoadStep::size}};
}
std::vector<Field<SensorHold>> fields(const SensorHold&) {
  return {{"samples", &SensorHold::samples}};
}
std::vector<Field<SensorQuantisation>> fields(const SensorQuantisation&) {
  return {{"step", &SensorQuantisation::step}};
}

double number(std::string_view where, const EffectArgument& argument) {
  double value = 0.0;
  const char* end = argument.value.data() + argument.value.size();
  const auto [stop, error] = std::from_chars(argument.value.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) {
    throw std::invalid_argument(std::string(where) + ": " + argument.name + "=" + argument.value +
                                " is not a number");
  }
  return value;
}

StictionLaw law_of(const std::string& value) {
  for (const StictionLaw law : {StictionLaw::choudhury, StictionLaw::kano}) {
    if (value == name(law)) {
      return law;
    }
  }
  throw std::invalid_argument("valve_stiction: law=" + value + " is neither choudhury nor kano");
}

template <class E>
void set(E& effect, const EffectArgument& argument) {
  if constexpr (std::is_same_v<E, ValveStiction>) {
    if (argument.name == "law") {
      effect.law = law_of(argument.value);
      return;
    }
  }
  for (const Field<E>& field : fields(effect)) {
    if (field.name == argument.name) {
      effect.*field.member = number(word(effect), argument);
      return;
    }
  }
  throw std::invalid_argument(std::string(word(effect)) + ": no parameter " + argument.name);
}

template <class E>
void check_range(const E& effect) {
  check(effect);
}
void check_range(const ValveStiction& stiction) {
  StickingValve{stiction};
}
void check_range(const ValveDeadband& deadband) {
  ValveWithPlay{deadband};
}

/// The alternative called `wanted` with its standard values, searched from number `at` on.
template <std::size_t at = 0>
Effect standard_effect(std::string_view wanted) {
  if constexpr (at == std::variant_size_v<Effect>) {
    throw std::invalid_argument("no effect is called " + std::string(wanted));
  } else {
    const std::variant_alternative_t<at, Effect> candidate;
    return word(candidate) == wanted ? Effect(candidate) : standard_effect<at + 1>(wanted);
  }
}

}  // namespace

std::string_view name(const Effect& effect) {
  return std::visit([](const auto& one) { return word(one); }, effect);
}

void check(const Effect& effect) {
  std::visit([](const auto& one) { check_range(one); }, effect);
}

Effect make_effect(std::string_view name, std::span<const EffectArgument> arguments) {
  Effect effect = standard_effect(name);
  for (const EffectArgument& argument : arguments) {
    std::visit([&argument](auto& one) { set(one, argument); }, effect);
  }
  check(effect);
  return effect;
}

const std::vector<EffectDescription>& all_effects() {
  static const std::vector<EffectDescription> descriptions = {
      {"valve_stiction",
       {"S", "J", "law"},
       "S=3 J=1 (% of op), law=choudhury or kano",
       "rests until op has moved by more than S, then mv = op - d (S - J) / 2"},
      {"valve_deadband",
       {"width"},
       "width=2 (full width, % of op)",
       "mv = max(op - width/2, min(op + width/2, mv before))"},
      {"valve_saturation",
       {"low", "high"},
       "low=0 high=100 (% of travel)",
       "mv = min(max(mv, low), high)"},
      {"valve_characteristic",
       {"curvature"},
       "curvature=0.3 (-0.5 to 0.5)",
       "flow = mv + c (mv - 50)^2 / 50"},
      {"gain_change",
       {"at", "rate", "ratio"},
       "at=2000 (s), rate=0 (1/h, 0 = at once), ratio=2",
       "process gain times 1 before, ratio after"},
      {"process_nonlinearity",
       {"curvature"},
       "curvature=0.5 (-1 to 1)",
       "y -> y + c y^2 / 50 about the operating point"},
      {"external_oscillation",
       {"period_s", "amplitude"},
       "period_s=100 amplitude=2 (pv units)",
       "d(t) = amplitude sin(2 pi t / period_s)"},
      {"load_step", {"at", "size"}, "at=2000 (s), size=5 (pv units)", "d(t) = size from t = at on"},
      {"sensor_hold", {"samples"}, "samples=10", "pv renewed every so many samples"},
      {"sensor_quantisation", {"step"}, "step=1 (pv units)", "pv = step round(pv / step)"},
  };
  return descriptions;
}

}  // namespace loopscope::core::simulate
