#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.hpp"
#include "storage/catalogue_entry.hpp"
#include "storage/connection_settings.hpp"
#include "storage/results/schema/past_months.hpp"

namespace loopscope::daemon {

/// What `loopscope backfill` is asked for.
struct BackfillOptions {
  std::string since;               ///< a time, as time_option() reads it
  std::string every;               ///< as parse_duration() reads it
  std::vector<std::string> loops;  ///< names; empty = all enabled ones
  bool again = false;              ///< whether windows that were judged before are looked at, too
};

/// Loops and times at which they are to be judged.
struct BackfillPlan {
  std::vector<storage::CatalogueEntry> loops;
  std::vector<std::int64_t> times_us;  ///< ascending, microseconds UTC since 1970
};

/// "90s", "15min", "6h", "1d", "1w" as microseconds, > 0; a number alone is seconds. Throws Failure
/// (usage) for anything else.
[[nodiscard]] std::int64_t parse_duration(std::string_view text);

/// The plan up to `newest_us`, the newest slot that has settled. Throws Failure: usage for a time
/// or a duration that is none, for a time in the future or before what results.retention_months
/// keeps, for loops that the catalogue does not have or that are disabled, and for more windows
/// than anybody can want; database where months have no partitions. Throws storage::DatabaseError.
[[nodiscard]] BackfillPlan plan_backfill(const config::Settings& settings,
                                         const BackfillOptions& options, std::int64_t newest_us);

/// The months of results from `since_us` on. Throws Failure (usage) where `maintain` would drop the
/// first of them again, and storage::DatabaseError.
[[nodiscard]] storage::PastMonths months_to_keep(const storage::ConnectionSettings& connection,
                                                 const config::Settings& settings,
                                                 std::int64_t since_us);

}  // namespace loopscope::daemon
