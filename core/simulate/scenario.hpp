#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/simulate/loop.hpp"

namespace loopscope::core::simulate {

/// One entry of the closed list that `loopscope simulate` knows.
struct Scenario {
  std::string_view name;
  std::string_view description;  ///< one line for people
  bool is_loop = true;           ///< false: a pure signal of section 4, which has no op and mv
};

/// Every scenario: the paper's first, then plant loops.
[[nodiscard]] const std::vector<Scenario>& all_scenarios();

/// What may be asked of a scenario beside its seed.
struct ScenarioOptions {
  std::size_t samples = 4096;               ///< recorded, >= 1
  std::optional<double> sample_interval_s;  ///< nullopt = the scenario's own; its times scale along
  std::vector<Effect> added_effects;        ///< beside the scenario's own; loops only
};

/// The loop behind a scenario. Throws std::invalid_argument for a name that is no loop scenario.
[[nodiscard]] LoopSettings scenario_loop(std::string_view name,
                                         const ScenarioOptions& options = {});

/// One record of a scenario. A pure signal comes as sp = 0, pv = -signal, so that the error is the
/// signal, with op and mv empty. Throws std::invalid_argument for an unknown name, effects added
/// to a pure signal, and settings out of range.
[[nodiscard]] LoopRecord simulate_scenario(std::string_view name, const ScenarioOptions& options,
                                           std::uint64_t seed);

}  // namespace loopscope::core::simulate
