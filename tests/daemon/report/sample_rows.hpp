#pragma once

#include <string>

#include "daemon/report/plant/plant_section.hpp"
#include "storage/results/reports/listed_loops.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// A flagged loop in which every text is `text`: a name that somebody typed may stand anywhere.
[[nodiscard]] storage::FlaggedRow flagged_row(std::int64_t loop_id, const std::string& text);

/// A plant with one of everything, every text being `text`.
[[nodiscard]] PlantFacts plant_facts(const std::string& text);

[[nodiscard]] storage::ListedLoops without_areas(const storage::ListedLoops& loops);

}  // namespace loopscope::daemon
