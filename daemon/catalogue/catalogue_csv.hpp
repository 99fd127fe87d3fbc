#pragma once

#include <span>
#include <string>
#include <vector>

#include "daemon/text/csv_table.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// The loops as CSV text, one column per entry field.
[[nodiscard]] std::string catalogue_csv(std::span<const storage::CatalogueEntry> entries);

/// Whether a file with this header holds loops: it has one of their columns.
[[nodiscard]] bool is_header_of_catalogue(const std::vector<std::string>& header);

/// Loops out of such a table; columns may stand in any order. A loop whose name is among `stored`
/// keeps what the table has no column for; a new one has `defaults` there and needs name and
/// pv_tag. Throws Failure (unusable_data) naming line and column: an unknown or repeated column, a
/// bad cell, a name that stands twice.
[[nodiscard]] std::vector<storage::CatalogueEntry> parse_catalogue(
    const CsvTable& table, const storage::CatalogueEntry& defaults,
    std::span<const storage::CatalogueEntry> stored);

}  // namespace loopscope::daemon
