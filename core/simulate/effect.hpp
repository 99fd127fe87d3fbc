#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/simulate/effects/disturbance.hpp"
#include "core/simulate/effects/process_change.hpp"
#include "core/simulate/effects/sensor.hpp"
#include "core/simulate/effects/valve_deadband.hpp"
#include "core/simulate/effects/valve_stiction.hpp"
#include "core/simulate/effects/valve_travel.hpp"

namespace loopscope::core::simulate {

/// One effect of a simulated loop. The alternatives stand in the order in which a signal meets
/// them: valve, process, disturbance, sensor.
using Effect = std::variant<ValveStiction, ValveDeadband, ValveSaturation, ValveCharacteristic,
                            GainChange, ProcessNonlinearity, ExternalOscillation, LoadStep,
                            SensorHold, SensorQuantisation>;

/// The effect's word in settings, results and on the command line, e.g. "valve_stiction".
[[nodiscard]] std::string_view name(const Effect& effect);

/// Throws std::invalid_argument, naming effect and range, when a parameter is out of range.
void check(const Effect& effect);

/// One effect as people write it.
struct EffectDescription {
  std::string_view name;
  std::vector<std::string_view> parameters;  ///< their words, e.g. "S", "J", "law"
  std::string_view usage;                    ///< the parameters with units and standard values
  std::string_view formula;                  ///< the law in one line
};

/// Every effect, in the order of the variant.
[[nodiscard]] const std::vector<EffectDescription>& all_effects();

/// A parameter as read: its word and its value ("3", "kano").
struct EffectArgument {
  std::string name;
  std::string value;
};

/// The effect of that name; parameters that are not given keep their standard values. Throws
/// std::invalid_argument for an unknown name, an unknown parameter, a value that is no number
/// and a value out of range.
[[nodiscard]] Effect make_effect(std::string_view name, std::span<const EffectArgument> arguments);

}  // namespace loopscope::core::simulate
