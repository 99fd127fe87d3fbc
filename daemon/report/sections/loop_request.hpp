#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "daemon/report/sections/loop_query.hpp"

namespace loopscope::daemon {

/// Rows of a page of loops: with so many a page stays below 200 kB whatever their names and
/// reasons.
inline constexpr std::int64_t kLoopsOnPage = 150;

/// What the query of an address asks for: q (words), area, unit, verdict, state, order (a name of
/// LoopOrder), dir (desc = backwards), page (1 and more). What it does not say, or says in another
/// way, is as in LoopQuery.
[[nodiscard]] LoopQuery loop_query(const std::multimap<std::string, std::string>& query);

/// The address of that list, the same for equal queries; ready for an attribute.
[[nodiscard]] std::string loops_address(const LoopQuery& query);

[[nodiscard]] std::string name(LoopOrder order);

}  // namespace loopscope::daemon
