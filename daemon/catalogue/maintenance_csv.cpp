#include "daemon/catalogue/maintenance_csv.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <stdexcept>

#include "config/nearest_name.hpp"
#include "daemon/text/cells.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/read_time.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::array<std::string_view, 4> kColumns = {"loop", "at", "kind", "description"};
using Places = std::array<std::size_t, kColumns.size()>;

std::string known_kind(std::string_view kind) {
  const auto kinds = storage::maintenance_kinds();
  const std::vector<std::string> known(kinds.begin(), kinds.end());
  if (std::ranges::find(known, kind) != known.end()) return std::string(kind);
  const auto nearest = config::nearest_name(kind, known);
  throw std::invalid_argument(fmt::format("no kind of work \"{}\"{} (one of {})", kind,
                                          nearest ? ", did you mean " + *nearest : "",
                                          fmt::join(known, ", ")));
}

/// Where each of kColumns stands in the table.
Places places_of(const CsvTable& table) {
  Places places{};
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    const auto found = std::ranges::find(table.header, kColumns.at(i));
    places.at(i) = static_cast<std::size_t>(found - table.header.begin());
    if (found == table.header.end() || table.header.size() != kColumns.size()) {
      throw Failure(ExitCode::unusable_data,
                    fmt::format("{}, line 1: the columns, separated by {}, are {}", table.name,
                                separators_text(table.separator), fmt::join(table.header, ", ")),
                    fmt::format("a file of work has the columns {}", fmt::join(kColumns, ", ")));
    }
  }
  return places;
}

}  // namespace

storage::MaintenanceEntry maintenance_entry(std::string_view loop, std::string_view at,
                                            std::string_view kind, std::string_view description,
                                            const TimeZone& zone) {
  const auto done_at = read_time(trimmed(at), zone);
  if (const auto* problem = std::get_if<TimeProblem>(&done_at))
    throw std::invalid_argument(fmt::format("\"{}\" {} ({})", at, problem->what, problem->hint));
  if (trimmed(description).empty()) throw std::invalid_argument("what was done is not said");
  return {std::string(loop), std::get<std::int64_t>(done_at), known_kind(trimmed(kind)),
          std::string(trimmed(description))};
}

bool is_header_of_maintenance(const std::vector<std::string>& header) {
  return std::ranges::all_of(kColumns, [&](std::string_view column) {
    return std::ranges::find(header, column) != header.end();
  });
}

std::vector<storage::MaintenanceEntry> parse_maintenance(const CsvTable& table,
                                                         const TimeZone& zone) {
  const Places places = places_of(table);
  std::vector<storage::MaintenanceEntry> entries;
  for (const CsvTable::Row& row : table.rows) {
    const auto cell = [&](std::size_t column) { return row.cells[places.at(column)]; };
    try {
      entries.push_back(maintenance_entry(cell(0), cell(1), cell(2), cell(3), zone));
    } catch (const std::invalid_argument& problem) {
      throw Failure(ExitCode::unusable_data,
                    fmt::format("{}, line {}: {}", table.name, row.line, problem.what()),
                    "nothing was entered: correct the line and load the file again");
    }
  }
  return entries;
}

}  // namespace loopscope::daemon
