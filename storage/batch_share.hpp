#pragma once

#include <algorithm>
#include <cstddef>

namespace loopscope::storage {

/// A batch of one has what a batch costs to itself.
inline constexpr std::size_t kFewestOfBatch = 2;

/// How many of the loops that are left a batch takes: one of `sharers` (> 0) equal parts, so that
/// batches shrink towards the end and all workers come to it together, but no more than `limit`
/// (> 0). At least one where none seems to be left.
[[nodiscard]] inline int batch_share(std::size_t left, int limit, std::size_t sharers) {
  const std::size_t part = std::max((left + sharers - 1) / sharers, kFewestOfBatch);
  return static_cast<int>(std::min(part, static_cast<std::size_t>(limit)));
}

}  // namespace loopscope::storage
