#pragma once

#include <span>
#include <string>
#include <vector>

#include "daemon/catalogue/propose_entry.hpp"
#include "storage/historian/historian_reader.hpp"

namespace loopscope::daemon {

/// Values of pv and op of loops of ONE historian, in their order: of each tag up to 512 rows that
/// end at its newest one, and a day, a week and a month before, however long the history is: some
/// two seconds for a thousand loops in an indexed table that is in memory. Throws
/// storage::DatabaseError.
[[nodiscard]] std::vector<LoopValues> read_values(storage::HistorianReader& historian,
                                                  std::span<const storage::CatalogueEntry> loops);

/// Whether each tag has a row. Throws storage::DatabaseError.
[[nodiscard]] std::vector<bool> have_rows(storage::HistorianReader& historian,
                                          std::span<const std::string> tags);

}  // namespace loopscope::daemon
