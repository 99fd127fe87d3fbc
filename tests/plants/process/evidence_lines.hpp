#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/plant/shared_oscillation.hpp"

namespace loopscope::tests::process {

/// Of the file that tests/plants/network/fit_weights reads.
inline constexpr const char* kEvidenceHeader =
    "plant,source,height,setpoint,op,lead,direct,friction,outside,no_leader,cubic";

/// What the ranking of sources weighs, a line for every member of an event.
[[nodiscard]] std::vector<std::string> evidence_lines(
    const std::string& plant, const core::plant::SharedOscillation& event,
    std::span<const core::plant::MemberLoop> members, std::optional<std::size_t> source);

}  // namespace loopscope::tests::process
