#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "storage/connection_settings.hpp"

namespace loopscope::storage {

/// Months of results before this one, as far as somebody wants to fill them in.
struct PastMonths {
  bool kept = true;       ///< false: `maintain` drops the first of them with its next run
  std::string kept_from;  ///< "2026-01-01", the first day that it keeps; empty = all
  std::vector<std::string> missing;  ///< "2026-01": months without their partitions
};

/// The months from `since_us` (microseconds UTC since 1970, not after now()) to this one, with
/// `retention_months` (0 = all) as settings.results has it. Months are those of UTC. Throws
/// DatabaseError.
[[nodiscard]] PastMonths past_months(const ConnectionSettings& settings, std::int64_t since_us,
                                     int retention_months);

}  // namespace loopscope::storage
