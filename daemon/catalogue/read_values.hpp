#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "daemon/catalogue/check_tags.hpp"
#include "daemon/catalogue/propose_entry.hpp"
#include "storage/historian/historian_reader.hpp"

namespace loopscope::daemon {

/// Values of pv and op of loops of ONE historian, in their order: of each tag up to 512 rows that
/// end at its newest one, and a day, a week and a month before, however long the history is: some
/// two seconds for a thousand loops in an indexed table that is in memory. Throws
/// storage::DatabaseError.
[[nodiscard]] std::vector<LoopValues> read_values(storage::HistorianReader& historian,
                                                  std::span<const storage::CatalogueEntry> loops);

/// The newest row of each tag, and the historian's clock. Throws storage::DatabaseError.
[[nodiscard]] NewestRows newest_rows(storage::HistorianReader& historian,
                                     std::span<const std::string> tags);

/// The longest time between two of the newest 512 rows of each tag, of the 30 days before its
/// newest one, seconds; nullopt = fewer than 21 rows: too few to say what is usual. Throws
/// storage::DatabaseError.
[[nodiscard]] std::vector<std::optional<double>> longest_gaps(storage::HistorianReader& historian,
                                                              std::span<const std::string> tags);

}  // namespace loopscope::daemon
