#include "daemon/lab/simulate/effect_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>
#include <vector>

#include "config/nearest_name.hpp"
#include "core/simulate/scenario.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {

namespace {

using core::simulate::EffectArgument;
using core::simulate::EffectDescription;

std::string did_you_mean(const std::string& name, const std::vector<std::string>& known,
                         const std::string& otherwise) {
  const auto nearest = config::nearest_name(name, known);
  return nearest ? fmt::format("did you mean \"{}\"?", *nearest) : otherwise;
}

const EffectDescription& description_of(const std::string& name) {
  std::vector<std::string> known;
  for (const EffectDescription& effect : core::simulate::all_effects()) {
    if (effect.name == name) return effect;
    known.emplace_back(effect.name);
  }
  throw Failure(ExitCode::usage, fmt::format("unknown effect \"{}\"", name),
                did_you_mean(name, known, "loopscope simulate --list shows every effect"));
}

EffectArgument parse_argument(const EffectDescription& effect, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    throw Failure(ExitCode::usage,
                  fmt::format("effect {}: \"{}\" is not NAME=VALUE", effect.name, text),
                  fmt::format("parameters: {}", effect.usage));
  }
  EffectArgument argument{text.substr(0, equals), text.substr(equals + 1)};
  if (std::ranges::find(effect.parameters, argument.name) == effect.parameters.end()) {
    throw Failure(ExitCode::usage,
                  fmt::format("effect {}: unknown parameter \"{}\"", effect.name, argument.name),
                  did_you_mean(argument.name, {effect.parameters.begin(), effect.parameters.end()},
                               fmt::format("parameters: {}", effect.usage)));
  }
  return argument;
}

void require_new(const EffectDescription& effect, const std::vector<EffectArgument>& known,
                 const EffectArgument& argument) {
  if (std::ranges::find(known, argument.name, &EffectArgument::name) == known.end()) return;
  throw Failure(ExitCode::usage,
                fmt::format("effect {}: parameter \"{}\" stands twice", effect.name, argument.name),
                "give it once; a second effect of the kind takes a second --effect");
}

std::vector<EffectArgument> parse_arguments(const EffectDescription& effect,
                                            const std::string& text) {
  std::vector<EffectArgument> arguments;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    EffectArgument argument = parse_argument(effect, text.substr(start, end - start));
    require_new(effect, arguments, argument);
    arguments.push_back(std::move(argument));
    start = end + 1;
  }
  return arguments;
}

}  // namespace

core::simulate::Effect parse_effect(const std::string& text) {
  const std::size_t colon = text.find(':');
  const EffectDescription& effect = description_of(text.substr(0, colon));
  const auto arguments = colon == std::string::npos
                             ? std::vector<EffectArgument>{}
                             : parse_arguments(effect, text.substr(colon + 1));
  try {
    return core::simulate::make_effect(effect.name, arguments);
  } catch (const std::invalid_argument& error) {
    throw Failure(ExitCode::usage, error.what(), fmt::format("parameters: {}", effect.usage));
  }
}

void require_scenario(const std::string& name) {
  std::vector<std::string> known;
  for (const core::simulate::Scenario& scenario : core::simulate::all_scenarios()) {
    if (scenario.name == name) return;
    known.emplace_back(scenario.name);
  }
  throw Failure(ExitCode::usage, fmt::format("unknown scenario \"{}\"", name),
                did_you_mean(name, known, "loopscope simulate --list shows every scenario"));
}

}  // namespace loopscope::daemon
