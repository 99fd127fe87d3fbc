#include "tests/core/model/trial_records.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/model/effects/curvature.hpp"
#include "core/model/effects/external_oscillation.hpp"
#include "core/model/effects/gain_change.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/effects/saturation.hpp"
#include "core/model/selection/candidate_fit.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model::tests {

LoopData lagged_loop(std::uint64_t seed, std::size_t samples) {
  const Series op = stepping_op(samples, seed);
  const Series noise = coloured_noise(kNoise, samples, seed + 5000, 0.5);
  return make_loop_data(process_record(one_lag(0.8, 3), 1.5, op, noise), op, 1.0);
}

Structure truth(std::vector<EffectPtr> effects) {
  Structure structure = structure_of(one_lag(0.8, 3), std::move(effects));
  structure.noise = kNoise;
  return structure;
}

std::vector<double> p_without(const EffectPtr& effect, bool once, std::size_t records) {
  std::vector<double> result;
  for (std::uint64_t seed = 1; seed <= records; ++seed) {
    const LoopData data = lagged_loop(seed);
    const CrossFit before = cross_fit(data, polish(data, truth()));
    const Fit fit = refine_last(data, evaluate(data, truth({effect})));
    const CrossFit after = cross_fit(data, polish(data, fit.structure));
    result.push_back(compare(data, before, after, once).p);
  }
  return result;
}

double share_below(const std::vector<double>& p, double level) {
  const auto below = std::ranges::count_if(p, [&](double value) { return value <= level; });
  return static_cast<double>(below) / static_cast<double>(p.size());
}

std::vector<EffectPtr> absent_effects() {
  return {std::make_shared<ExternalOscillation>(50.0), std::make_shared<GainChange>(600, 600),
          std::make_shared<ValveCharacteristic>(), std::make_shared<ProcessNonlinearity>(),
          std::make_shared<Saturation>(-6.0, 1e9)};
}

}  // namespace loopscope::core::model::tests
