#pragma once

#include <string>

#include "daemon/report/sections/loop_section.hpp"

namespace loopscope::daemon {

/// Whether the loop is sound by itself and shaken by others: then it is shown as such, and not as
/// healthy.
[[nodiscard]] bool is_only_shaken(const LoopReport& story);

/// The code that the heading shows.
[[nodiscard]] std::string shown_code(const LoopReport& story);

/// "62 % of its error follows plant-wide oscillation 1 of FIC101 (period 40 s)", HTML.
[[nodiscard]] std::string follow_sentence(const storage::FollowedRow& followed);

/// Cause and action of a loop that is only shaken, in place of those of its verdict; HTML.
[[nodiscard]] std::string shaken_cause(const LoopReport& story);
[[nodiscard]] std::string shaken_action(const LoopReport& story);

/// What a loop follows besides what its verdict says: an entry of the list of findings; empty =
/// nothing.
[[nodiscard]] std::string follow_entry(const LoopReport& story);

}  // namespace loopscope::daemon
