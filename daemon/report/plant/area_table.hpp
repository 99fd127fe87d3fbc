#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "daemon/report/page/fields.hpp"
#include "storage/results/reports/listed_loops.hpp"

namespace loopscope::daemon {

/// An area of the plant and how its enabled loops stand.
struct AreaCounts {
  std::string area;  ///< empty = the loops that have none
  std::int64_t loops = 0, flagged = 0, not_controlling = 0, unjudgeable = 0;
  std::int64_t best_rank = 0;  ///< of its flagged loops; 0 = none is
};

/// By area in the order of the database, loops without an area last; empty where no loop has one.
[[nodiscard]] std::vector<AreaCounts> count_areas(const storage::ListedLoops& loops);

/// A table of them; `link_to` = where an area leads, empty = nowhere. Empty where there is none.
[[nodiscard]] Markup area_table(std::span<const AreaCounts> areas,
                                const std::function<std::string(const AreaCounts&)>& link_to);

/// "Area", or what stands for those without one.
[[nodiscard]] std::string area_words(const std::string& area);

}  // namespace loopscope::daemon
