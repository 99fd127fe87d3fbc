#include "storage/historian/check_historian.hpp"

#include <optional>
#include <string>

#include "storage/check_connection.hpp"
#include "storage/historian/check_index.hpp"
#include "storage/historian/native_time.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/refuse.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/scan_rows.hpp"
#include "storage/historian/scan_statements.hpp"
#include "storage/historian/statements.hpp"
#include "storage/historian/tag_value.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

// Without an index on the time alone the newest row needs a scan of the span: look at a week, and
// not for long.
constexpr std::int64_t kRecentUs = std::int64_t{7} * 86'400 * 1'000'000;
constexpr int kNewestRowTimeout_s = 10;

/// SQL of some value of a row: which tag's does not matter to rights and plans.
std::string any_value(const PqConnection& connection, const ResolvedLayout& layout) {
  if (layout.layout.shape == Shape::narrow) return value_of(connection, layout, "").value();
  for (const auto& [column, type] : layout.data.types) {
    if (const auto value = value_of(connection, layout, column)) return *value;
  }
  refuse(layout.layout, "no column of " + layout.data.sql + " holds numbers",
         "the columns of a loop_row or wide table are its values");
}

/// What the planner makes of the statement that reads windows: no index helps where it does not
/// use one (a view that converts its columns, statistics that are out of date).
Finding check_plan(PqConnection& connection, const ResolvedLayout& layout, std::int64_t now_us) {
  Scan scan{{}, now_us - kRecentUs, now_us, 4096, {}};
  for (const ResolvedKey& key : layout.key) {
    // A key that fits the type and that no row need have.
    scan.key.emplace_back(key.type == "uuid" ? "00000000-0000-0000-0000-000000000000" : "0");
  }
  scan.columns.push_back({any_value(connection, layout), false, {}});
  const Statement plan = historian_statements::explain(
      historian_statements::read_scans(layout, {layout.data.sql}, scan.columns));
  const PqRows rows = connection.run(plan, scan_parameters({scan}, layout));
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

/// nullopt when there is no index on the time alone and the server gave up: nothing is wrong with
/// that.
std::optional<PqRows> newest_row(PqConnection& connection, const ResolvedLayout& layout,
                                 std::int64_t now) {
  constexpr const char* kQueryCanceled = "57014";
  const TimeKind kind = layout.layout.time_kind;
  try {
    return connection.run(historian_statements::newest_row(layout, layout.data.sql),
                          {native_bound(kind, now - kRecentUs, Bound::lower),
                           native_bound(kind, kLatestTimeUs, Bound::upper)},
                          ResultFormat::binary);
  } catch (const DatabaseError& error) {
    if (error.sqlstate() == kQueryCanceled) return std::nullopt;
    throw;
  }
}

Finding check_newest(PqConnection& connection, const ResolvedLayout& layout, std::int64_t now) {
  const TimeKind kind = layout.layout.time_kind;
  const std::optional<PqRows> found = newest_row(connection, layout, now);
  if (!found) {
    return {true,
            "the newest row was not found within " + std::to_string(kNewestRowTimeout_s) + " s, " +
                layout.data.sql,
            "it is only this check that wants an index on the time alone", true};
  }
  const PqRows& rows = *found;
  if (rows.size() == 0) {
    return {true, "no row is younger than a week, " + layout.data.sql,
            "check that the historian records, and `time_kind`", true};
  }
  const std::int64_t newest = microseconds(kind, decode_value(rows.bytes(0, 0)));
  if (newest > now) {
    return {
        true,
        "the newest row lies in the future, at " + timestamp_text(newest) + ", " + layout.data.sql,
        "check `time_kind`, the time zone of the recorder and its clock", true};
  }
  return {true, "the newest row is of " + timestamp_text(newest) + ", " + layout.data.sql, "",
          false};
}

std::int64_t database_now_us(PqConnection& connection) {
  return std::stoll(connection.run(historian_statements::kNow).text(0, 0));
}

}  // namespace

std::vector<Finding> check_historian(const ConnectionSettings& settings,
                                     const SourceLayout& layout) {
  ConnectionSettings reader = settings;
  reader.read_only = true;
  reader.statement_timeout_s = kNewestRowTimeout_s;
  std::vector<Finding> findings;
  try {
    findings = check_connection(reader);
    PqConnection connection(reader);
    findings.push_back({true, "connected to the " + connection.target(), "", false});
    const ResolvedLayout resolved = resolve_layout(connection, layout);
    connection.run(historian_statements::try_read(resolved, any_value(connection, resolved)));
    findings.push_back({true, resolved.data.sql + " has the columns and can be read", "", false});
    const std::int64_t now_us = database_now_us(connection);
    findings.push_back(check_index(connection, resolved));
    findings.push_back(check_plan(connection, resolved, now_us));
    findings.push_back(check_newest(connection, resolved, now_us));
  } catch (const DatabaseError& error) {
    findings.push_back({false, error.what(), error.hint(), false});
  } catch (const MalformedArray& error) {
    findings.push_back({false, std::string(error.what()) + ", " + layout.relation,
                        "report this with the server's version", false});
  }
  return findings;
}

}  // namespace loopscope::storage
