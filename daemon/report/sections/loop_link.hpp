#pragma once

#include <cstdint>
#include <string>

namespace loopscope::daemon {

/// Where a loop's name leads: to its section of the same page, or to a page of its own.
enum class LoopLinks { sections, pages };

/// Address of a loop's section or page, ready for an attribute.
[[nodiscard]] std::string loop_link(LoopLinks links, std::int64_t loop_id,
                                    const std::string& loop_name);

}  // namespace loopscope::daemon
