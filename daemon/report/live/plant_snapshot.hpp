#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "daemon/report/plant/plant_section.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// One moment of the results as all pages of the plant show it: read once for all readers and all
/// questions, because the two lists cost the database the same whatever is asked of them.
struct PlantSnapshot {
  using Clock = std::chrono::steady_clock;

  PlantFacts facts;                                                ///< without pictures
  std::map<std::int64_t, std::vector<storage::HiddenRow>> hidden;  ///< by loop
  Clock::time_point read_at;
  Clock::duration took{};  ///< the reading

  /// The loop's row of the work list; nullptr = it is not on it.
  [[nodiscard]] const storage::FlaggedRow* flagged(const std::string& loop_name) const;
  [[nodiscard]] std::vector<storage::HiddenRow> hidden_by(std::int64_t loop_id) const;
};

/// What is new is so since a week. Throws storage::DatabaseError.
[[nodiscard]] PlantSnapshot read_plant(const config::Settings& settings);

}  // namespace loopscope::daemon
