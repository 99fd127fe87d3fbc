#include "storage/historian/check_historian.hpp"

#include <string>

#include "storage/historian/native_time.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/statements.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

// Without an index on the time alone the newest row needs a scan of the span: look at a week, and
// not for long.
constexpr std::int64_t kRecentUs = std::int64_t{7} * 86'400 * 1'000'000;
constexpr int kPatience_s = 10;

Finding check_index(PqConnection& connection, const ResolvedLayout& layout) {
  const NarrowLayout& names = layout.layout;
  if (!layout.is_table) {
    return {true, names.relation + " is a view or a foreign table: its indexes were not checked",
            "make sure that the table behind it has an index on (tag, time)", true};
  }
  const PqRows rows =
      connection.run(historian_statements::kIndexes,
                     {std::to_string(layout.relation_oid), names.tag_column, names.time_column});
  const std::string included = layout.value + (layout.quality.empty() ? "" : ", " + layout.quality);
  const std::string hint = "CREATE INDEX CONCURRENTLY ON " + layout.relation + " (" + layout.tag +
                           ", " + layout.time + ") INCLUDE (" + included + ")";
  if (rows.size() == 0) {
    return {
        false,
        "no index starts with (tag, time), so every window would scan the table, " + names.relation,
        hint, false};
  }
  const std::string covered = "," + rows.text(0, 0) + ",";
  if (covered.find("," + names.value_column + ",") == std::string::npos) {
    return {true,
            "the index on (tag, time) does not include the value: reading is some three "
            "times slower than it could be, " +
                names.relation,
            hint, true};
  }
  return {true, "an index covers tag, time and value, " + names.relation, "", false};
}

Finding check_newest(PqConnection& connection, const ResolvedLayout& layout) {
  const TimeKind kind = layout.layout.time_kind;
  const std::int64_t now = std::stoll(connection.run(historian_statements::kNow).text(0, 0));
  const PqRows rows =
      connection.run(historian_statements::newest_row(layout),
                     {native_bound(kind, now - kRecentUs, Bound::lower)}, ResultFormat::binary);
  if (rows.size() == 0) {
    return {true, "no row is younger than a week, " + layout.layout.relation,
            "check that the historian records, and `time_kind`", true};
  }
  const std::int64_t newest = microseconds(kind, decode_value(rows.bytes(0, 0)));
  if (newest > now) {
    return {true,
            "the newest row lies in the future, at " + timestamp_text(newest) + ", " +
                layout.layout.relation,
            "check `time_kind`, the time zone of the recorder and its clock", true};
  }
  return {true, "the newest row is of " + timestamp_text(newest) + ", " + layout.layout.relation,
          "", false};
}

}  // namespace

std::vector<Finding> check_historian(const ConnectionSettings& settings,
                                     const NarrowLayout& layout) {
  ConnectionSettings reader = settings;
  reader.read_only = true;
  reader.statement_timeout_s = kPatience_s;
  std::vector<Finding> findings;
  try {
    PqConnection connection(reader);
    findings.push_back({true, "connected to the " + connection.target(), "", false});
    const ResolvedLayout resolved = resolve_layout(connection, layout);
    connection.run(historian_statements::try_read(resolved));
    findings.push_back({true, layout.relation + " has the columns and can be read", "", false});
    findings.push_back(check_index(connection, resolved));
    findings.push_back(check_newest(connection, resolved));
  } catch (const DatabaseError& error) {
    findings.push_back({false, error.what(), error.hint(), false});
  } catch (const MalformedArray& error) {
    findings.push_back({false, std::string(error.what()) + ", " + layout.relation,
                        "report this with the server's version", false});
  }
  return findings;
}

}  // namespace loopscope::storage
