#pragma once

#include <cstdint>
#include <string_view>

namespace loopscope::daemon {

/// Seed of record `index` of a stream: the same on every machine, whatever other streams there are
/// and in whatever order records are drawn.
[[nodiscard]] std::uint64_t record_seed(std::string_view stream, std::uint64_t index);

}  // namespace loopscope::daemon
