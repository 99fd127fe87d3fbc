#pragma once

#include <vector>

#include "core/model/effect.hpp"
#include "core/model/loop_data.hpp"

namespace loopscope::core::model {

/// Valves that the model may lack. Bands, jumps and laws are sought on all rows (half of them leave
/// too little to follow a valve by); where pv puts a valve right comes from the fit rows and the
/// start of the record alone.
[[nodiscard]] std::vector<EffectPtr> nominate_valves(const LoopData& data);

}  // namespace loopscope::core::model
