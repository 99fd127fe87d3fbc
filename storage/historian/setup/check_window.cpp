#include "storage/historian/setup/check_window.hpp"

#include <chrono>
#include <optional>

#include "core/signal/microseconds.hpp"
#include "storage/historian/native_time.hpp"
#include "storage/historian/refuse.hpp"
#include "storage/historian/scan_rows.hpp"
#include "storage/historian/scan_statements.hpp"
#include "storage/historian/setup/check_foreign.hpp"
#include "storage/historian/statements.hpp"
#include "storage/historian/tag_value.hpp"

namespace loopscope::storage {
namespace {

constexpr std::int64_t kDayUs = std::int64_t{86'400} * 1'000'000;
constexpr std::int64_t kWindowRows = 4096;

Scan scan_of(const PqConnection& connection, const ResolvedLayout& layout, std::int64_t from_us,
             std::int64_t to_us) {
  Scan scan{{}, from_us, to_us, kWindowRows, {}};
  scan.columns.push_back({any_value(connection, layout), true, {}});
  return scan;
}

/// The plan of a window of the last week.
PqRows plan_of_window(PqConnection& connection, const ResolvedLayout& layout, std::int64_t now_us) {
  Scan scan = scan_of(connection, layout, now_us - 7 * kDayUs, now_us);
  for (const ResolvedKey& key : layout.key) {
    // A key that fits the type and that no row need have.
    scan.key.emplace_back(key.type == "uuid" ? "00000000-0000-0000-0000-000000000000" : "0");
  }
  const Statement plan = historian_statements::explain(
      historian_statements::read_scans(layout, {layout.data.sql}, scan.columns), layout.foreign);
  return connection.run(plan, scan_parameters({scan}, layout));
}

/// No index helps where the planner does not use one: a view that converts its columns, statistics
/// that are out of date.
Finding check_plan(const PqRows& rows, const ResolvedLayout& layout) {
  for (int row = 0; row < rows.size(); ++row) {
    const std::string line = rows.text(row, 0);
    if (line.find("Seq Scan") == std::string::npos) continue;
    return {
        true,
        "the plan of a window scans a whole table: " + line.substr(line.find("Seq Scan")) + ", " +
            layout.data.sql,
        "expected of a table that is nearly empty; else create the index, run ANALYZE, and keep "
        "conversions of tag and time out of views",
        true};
  }
  return {true, "the plan of a window uses indexes only, " + layout.data.sql, "", false};
}

/// The days about some row, as a scan of its key; nullopt = there is no row.
std::optional<Scan> scan_of_some_tag(PqConnection& connection, const ResolvedLayout& layout) {
  const PqRows rows = connection.run(historian_statements::any_row(layout, layout.data.sql), {},
                                     ResultFormat::binary);
  if (rows.size() == 0) return std::nullopt;
  const int parts = static_cast<int>(layout.key.size());
  const std::int64_t time_us =
      microseconds(layout.layout.time_kind, decode_value(rows.bytes(0, parts)));
  Scan scan = scan_of(connection, layout, time_us - kDayUs, time_us + kDayUs);
  for (int part = 0; part < parts; ++part) scan.key.push_back(rows.text(0, part));
  return scan;
}

std::string seconds_since(std::chrono::steady_clock::time_point start) {
  using Milliseconds = std::chrono::milliseconds;
  const auto elapsed = std::chrono::steady_clock::now() - start;
  return std::to_string(std::chrono::duration_cast<Milliseconds>(elapsed).count()) + " ms";
}

std::optional<Finding> try_window(PqConnection& connection, const ResolvedLayout& layout) {
  const std::optional<Scan> scan = scan_of_some_tag(connection, layout);
  if (!scan) return std::nullopt;
  const auto start = std::chrono::steady_clock::now();
  const PqRows rows =
      connection.run(historian_statements::read_scans(layout, {layout.data.sql}, scan->columns),
                     scan_parameters({*scan}, layout), ResultFormat::binary);
  const std::size_t found = rows.size() == 0 ? 0 : rows_of_span(rows, 0, layout);
  return Finding{true,
                 "the window of a tag was read, rows: " + std::to_string(found) + " in " +
                     seconds_since(start) + ", " + layout.data.sql,
                 "", false};
}

/// What the server refuses to carry out is a finding like any other.
std::optional<Finding> check_reading(PqConnection& connection, const ResolvedLayout& layout) {
  try {
    return try_window(connection, layout);
  } catch (const DatabaseError& error) {
    if (error.remedy() == Remedy::reconnect) throw;
    return Finding{false, "the window of a tag cannot be read: " + std::string(error.what()),
                   error.hint(), false};
  }
}

}  // namespace

std::string any_value(const PqConnection& connection, const ResolvedLayout& layout) {
  if (layout.layout.shape == Shape::narrow) return value_of(connection, layout, "").value();
  for (const auto& [column, type] : layout.data.types) {
    if (const auto value = value_of(connection, layout, column)) return *value;
  }
  refuse(layout.layout, "no column of " + layout.data.sql + " holds numbers",
         "the columns of a loop_row or wide table are its values");
}

std::vector<Finding> check_window(PqConnection& connection, const ResolvedLayout& layout,
                                  std::int64_t now_us) {
  const PqRows plan = plan_of_window(connection, layout, now_us);
  std::vector<Finding> findings =
      layout.foreign ? check_foreign(plan, layout.data.sql) : std::vector{check_plan(plan, layout)};
  if (auto reading = check_reading(connection, layout)) findings.push_back(*std::move(reading));
  return findings;
}

}  // namespace loopscope::storage
