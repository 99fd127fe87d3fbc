#pragma once

#include <vector>

#include "core/model/fit/fit.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// Effects that the model may lack, with nonlinear parameters to start from: for each kind a few
/// places on a coarse net, or what the innovations point at. Kinds that the fit has already are
/// left out by the caller.
///
/// `asked`: what the residual tests say of that effect. Their periods are where waves start;
/// places, limits and bands start from nets and from the marks of a load. A valve with hysteresis
/// has a search of its own.
[[nodiscard]] std::vector<EffectPtr> nominate(EffectKind kind, const LoopData& data, const Fit& fit,
                                              const std::vector<Nomination>& asked = {});
/// Limits, bent trims and bent processes.
[[nodiscard]] std::vector<EffectPtr> nominate_static(EffectKind kind, const LoopData& data);
/// Of those, the trims whose gain rises, or falls, along the whole travel.
[[nodiscard]] std::vector<EffectPtr> nominate_trims(const LoopData& data);
[[nodiscard]] std::vector<EffectPtr> nominate_gain_changes(const LoopData& data, const Fit& fit);
[[nodiscard]] std::vector<EffectPtr> nominate_load_steps(const LoopData& data, const Fit& fit);
[[nodiscard]] std::vector<EffectPtr> nominate_oscillations(const LoopData& data, const Fit& fit);

}  // namespace loopscope::core::model
