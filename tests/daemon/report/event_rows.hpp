#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

inline constexpr std::int64_t kEventStart_us = 1'772'366'400'000'000;  // 2026-03-01T12:00:00Z

/// `loops` loops that swing with 40 s, numbered and named from 1 on ("L1", the source), each 3 s
/// later than the one before, which also foretells it.
inline storage::PlantOscillationRow sample_event(std::size_t loops) {
  storage::PlantOscillationRow event;
  event.number = 1;
  event.period_s = 40.0;
  event.source_name = "L1";
  event.statement = "L1 leads.";
  event.outside = 0.125;
  for (std::size_t k = 0; k < loops; ++k) {
    const auto id = static_cast<std::int64_t>(k) + 1;
    const double late_s = 3.0 * static_cast<double>(k);
    event.members.push_back({id,
                             "L" + std::to_string(id),
                             k == 0 ? "source" : "victim",
                             0.9 / static_cast<double>(id),
                             late_s,
                             k == 0 ? 0.75 : 0.01,
                             {}});
    if (k > 0) event.leads.push_back({id - 1, id, 0.5});
    storage::PlantTrace trace{id, kEventStart_us, 2.0, {}, {5.0, 40.0, 400.0}, {0.1, 4.0, 0.2}};
    for (std::size_t j = 0; j < 240; ++j)
      trace.error.push_back(std::sin(2.0 * std::numbers::pi *
                                     (2.0 * static_cast<double>(j) - late_s) / event.period_s));
    if (k < 8) event.traces.push_back(trace);
  }
  return event;
}

}  // namespace loopscope::daemon
