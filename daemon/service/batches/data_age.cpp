#include "daemon/service/batches/data_age.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/signal/microseconds.hpp"

namespace loopscope::daemon {

void note_data(const std::string& source, std::span<const LoopTask> visits, Metrics& metrics) {
  std::optional<std::int64_t> youngest_us;
  std::size_t unknown = 0;
  for (const LoopTask& visit : visits) {
    for (const TagReading& tag : visit.newest.at_slot.tags) {
      unknown += tag.unknown_rows;
      if (!tag.newest_row_us) continue;
      const std::int64_t age_us = tag.asked_us - *tag.newest_row_us;
      youngest_us = std::min(youngest_us.value_or(age_us), age_us);
    }
  }
  if (youngest_us) {
    metrics.data_age(source,
                     static_cast<double>(*youngest_us) / core::signal::kMicrosecondsPerSecond);
  }
  if (unknown > 0) metrics.unknown_quality(source, unknown);
}

}  // namespace loopscope::daemon
