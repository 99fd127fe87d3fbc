#pragma once

#include <cstdint>

#include "config/settings.hpp"
#include "daemon/report/plant/plant_section.hpp"
#include "storage/results/reports/report_database.hpp"

namespace loopscope::daemon {

/// What the first screen tells, but its pictures: all of one moment. What began after `since_us` is
/// new. Throws storage::DatabaseError.
[[nodiscard]] PlantFacts read_plant_facts(storage::ReportDatabase& database,
                                          const config::Settings& settings, std::int64_t since_us);

}  // namespace loopscope::daemon
