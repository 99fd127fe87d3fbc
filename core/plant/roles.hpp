#pragma once

#include <span>
#include <vector>

#include "core/plant/cascade.hpp"
#include "core/plant/shared_oscillation.hpp"

namespace loopscope::core::plant {

/// Gives every member but the source its role.
///
/// A loop keeps its place on the work list (`member`) when its own verdict blames a valve, a sensor
/// or the process with enough confidence, or its tuning and no loop is named as the source, or when
/// the oscillation is only a small part of what its error does. Friction, which is what a cycle is
/// blamed on, does not keep it there when another loop is named as the source, most of the error is
/// the shared oscillation and the loop is not likely the source itself. Of a cascade both of whose
/// loops are members, those that are victims are `cascade_master` and `cascade_slave` instead.
void assign_roles(SharedOscillation& event, std::span<const MemberLoop> loops,
                  std::span<const CascadePair> cascades, const PlantSettings& settings);

}  // namespace loopscope::core::plant
