#pragma once

#include <span>
#include <string>
#include <vector>

#include "daemon/recording/csv_table.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// The loops as CSV text, one column per entry field.
[[nodiscard]] std::string catalogue_csv(std::span<const storage::CatalogueEntry> entries);

/// Loops out of such a table; columns may stand in any order, only name and pv_tag are required,
/// what is left out has `defaults`. Throws Failure (unusable_data) naming line and column: an
/// unknown column, a bad cell, a name that stands twice.
[[nodiscard]] std::vector<storage::CatalogueEntry> parse_catalogue(
    const CsvTable& table, const storage::CatalogueEntry& defaults);

}  // namespace loopscope::daemon
