#pragma once

#include <vector>

#include "core/model/effect.hpp"
#include "core/model/loop_data.hpp"

namespace loopscope::core::model {

/// Valves that the model may lack. Bands, jumps and laws are sought on all rows (half of them leave
/// too little to follow a valve by); where pv puts a valve right comes from the fit rows and the
/// start of the record alone. None where the rows are fewer than the samples: pv says too seldom
/// where the valve is.
[[nodiscard]] std::vector<EffectPtr> nominate_valves(const LoopData& data);

}  // namespace loopscope::core::model
