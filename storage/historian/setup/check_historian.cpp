#include "storage/historian/setup/check_historian.hpp"

#include <optional>
#include <string>
#include <utility>

#include "storage/check_connection.hpp"
#include "storage/historian/check_index.hpp"
#include "storage/historian/native_time.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/scan_statements.hpp"
#include "storage/historian/setup/check_window.hpp"
#include "storage/historian/setup/read_grants.hpp"
#include "storage/historian/statements.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

// Without an index on the time alone the newest row needs a scan of the span: look at a week, and
// not for long.
constexpr std::int64_t kRecentUs = std::int64_t{7} * 86'400 * 1'000'000;
constexpr int kNewestRowTimeout_s = 10;

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

/// Nobody reads microseconds.
std::string second_text(std::int64_t time_us) {
  const std::string text = timestamp_text(time_us);
  return text.substr(0, text.find('.')) + " UTC";
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
    return {true,
            "the newest row lies in the future, at " + second_text(newest) + ", " + layout.data.sql,
            "check `time_kind`, the time zone of the recorder and its clock", true};
  }
  return {true, "the newest row is of " + second_text(newest) + ", " + layout.data.sql, "", false};
}

void check_reading(PqConnection& connection, const ResolvedLayout& layout,
                   std::vector<Finding>& findings) {
  const std::int64_t now_us = std::stoll(connection.run(historian_statements::kNow).text(0, 0));
  findings.push_back(check_index(connection, layout));
  for (Finding& found : check_window(connection, layout, now_us))
    findings.push_back(std::move(found));
  findings.push_back(check_newest(connection, layout, now_us));
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
    if (const auto lacking = check_read_rights(connection, resolved)) {
      findings.push_back(*lacking);
      return findings;
    }
    connection.run(historian_statements::try_read(resolved, any_value(connection, resolved)));
    findings.push_back({true, resolved.data.sql + " has the columns and can be read", "", false});
    check_reading(connection, resolved, findings);
  } catch (const DatabaseError& error) {
    findings.push_back({false, error.what(), error.hint(), false});
  } catch (const MalformedArray& error) {
    findings.push_back({false, std::string(error.what()) + ", " + layout.relation,
                        "report this with the server's version", false});
  }
  return findings;
}

}  // namespace loopscope::storage
