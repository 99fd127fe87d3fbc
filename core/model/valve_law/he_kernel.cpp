#include "core/model/valve_law/he_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/model/valve_law/he_kernel.cpp"  // once for each processor
#include <hwy/foreach_target.h>
// The above includes this file again, so that what follows stands behind it.
#include <algorithm>
#include <cmath>
#include <hwy/highway.h>

#include "core/model/valve_law/valve_lanes-inl.hpp"
#include "core/model/vectors/eight_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model {
inline namespace HWY_NAMESPACE {

/// Where there are fewer than eight valves the last one stands in the other places too.
void follow_he(std::span<const Valve> valves, std::span<const double> op,
               std::span<EightNumbers> mv) {
  ValveLanes<EightPart, kVectorsOfEight> lanes;
  decltype(lanes)::Frictions frictions{};
  for (std::size_t lane = 0; lane < kSideBySide; ++lane)
    lanes.put_in(lane, valves[std::min(lane, valves.size() - 1)], op[0], frictions);
  for (std::size_t k = 0; k < op.size(); ++k) {
    // Of op's motion this law asks nothing.
    if (!std::isnan(op[k])) lanes.step<ValveLaw::he>(frictions, OpStep<double>{op[k], 0, 0, 0, 0});
    for (std::size_t part = 0; part < kVectorsOfEight; ++part)
      HWY_NAMESPACE::put_part(mv[k], part, lanes.position[part]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace loopscope::core::model
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace loopscope::core::model {

HWY_EXPORT(follow_he);

void run_he_valves(std::span<const Valve> valves, std::span<const double> op,
                   std::span<EightNumbers> mv) {
  HWY_DYNAMIC_DISPATCH(follow_he)(valves, op, mv);
}

}  // namespace loopscope::core::model

#endif
