#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/model/fit/trial.hpp"
#include "core/model/record/loop_data.hpp"

/// Loops of one lag in noise, and what trials say of effects that they do not have.
namespace loopscope::core::model::tests {

[[nodiscard]] LoopData lagged_loop(std::uint64_t seed, std::size_t samples = 1200);
/// Their model, with these effects.
[[nodiscard]] Structure truth(std::vector<EffectPtr> effects = {});

[[nodiscard]] std::vector<EffectPtr> absent_effects();
/// p of `records` loops in which an effect that is not there is fitted in full.
[[nodiscard]] std::vector<double> p_without(const EffectPtr& effect, bool once,
                                            std::size_t records);
[[nodiscard]] double share_below(const std::vector<double>& p, double level);

}  // namespace loopscope::core::model::tests
