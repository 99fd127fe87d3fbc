#include "storage/results/catalogue/maintenance.hpp"

#include "storage/array_literal.hpp"
#include "storage/results/rows/loop_row.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {
namespace {

const Statement kRefuseMaintenance{"refuse_maintenance", R"(
    SELECT place, CASE WHEN loop.loop_id IS NULL THEN 'unknown_loop'
                       WHEN entry.done_at > now() THEN 'in_future'
                       ELSE 'entered_already' END AS reason
    FROM (SELECT *, row_number() OVER (PARTITION BY loop_name, done_at, description ORDER BY place)
                      AS times
          FROM unnest($1::text[], $2::timestamptz[], $3::text[], $4::text[])
            WITH ORDINALITY AS given (loop_name, done_at, kind, description, place)) AS entry
    LEFT JOIN loopscope.loop ON loop.name = entry.loop_name
    WHERE loop.loop_id IS NULL OR entry.done_at > now() OR times > 1
       OR EXISTS (SELECT FROM loopscope.maintenance_event AS known
                  WHERE known.loop_id = loop.loop_id AND known.done_at = entry.done_at
                    AND known.description = entry.description)
    ORDER BY place)"};

const Statement kAddMaintenance{"add_maintenance", R"(
    INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description, on_behalf_of)
    SELECT loop.loop_id, entry.done_at, entry.kind, entry.description, nullif(entry.name, '')
    FROM unnest($1::text[], $2::timestamptz[], $3::text[], $4::text[], $5::text[])
      AS entry (loop_name, done_at, kind, description, name)
    JOIN loopscope.loop ON loop.name = entry.loop_name)",
                                Rows::none};

/// $1 = whether of these names only, $2 = names.
const Statement kListMaintenance{"list_maintenance", R"(
    SELECT maintenance_event_id, loop_name, (extract(epoch FROM done_at) * 1000000)::bigint
             AS done_at_us, kind, description, word, statement, author, on_behalf_of
    FROM loopscope.before_after_maintenance
    WHERE NOT $1::boolean OR loop_id IN (SELECT loop_id FROM loopscope.loop
                                         WHERE name = ANY ($2::text[]))
    ORDER BY loop_name, done_at, maintenance_event_id)"};

std::vector<std::string> entry_parameters(std::span<const MaintenanceEntry> entries) {
  ArrayLiteral loop_name, done_at, kind, description, on_behalf_of;
  for (const MaintenanceEntry& entry : entries) {
    loop_name.add_text(entry.loop_name);
    done_at.add_time(entry.done_at_us);
    kind.add_text(entry.kind);
    description.add_text(entry.description);
    on_behalf_of.add_text(entry.on_behalf_of.value_or(""));
  }
  return {loop_name.text(), done_at.text(), kind.text(), description.text(), on_behalf_of.text()};
}

MaintenanceRefusal refusal_of(const std::string& reason) {
  if (reason == "unknown_loop") return MaintenanceRefusal::unknown_loop;
  if (reason == "in_future") return MaintenanceRefusal::in_future;
  return MaintenanceRefusal::entered_already;
}

MaintenanceRow read_maintenance(const pqxx::row& row) {
  MaintenanceRow read;
  read.maintenance_event_id = row["maintenance_event_id"].as<std::int64_t>();
  read.entry = {read_text(row["loop_name"]), row["done_at_us"].as<std::int64_t>(),
                read_text(row["kind"]), read_text(row["description"]),
                maybe_text(row["on_behalf_of"])};
  if (!row["word"].is_null()) read.word = read_text(row["word"]);
  read.statement = read_text(row["statement"]);
  read.author = read_text(row["author"]);
  return read;
}

}  // namespace

std::span<const std::string> maintenance_kinds() {
  static const std::vector<std::string> kinds = {"valve", "sensor", "tuning", "process", "other"};
  return kinds;
}

struct MaintenanceLog::Impl {
  explicit Impl(const ConnectionSettings& settings) : session(settings) {
    require_schema_version(session);
  }
  Session session;
};

MaintenanceLog::MaintenanceLog(const ConnectionSettings& settings)
    : impl_(std::make_unique<Impl>(settings)) {}
MaintenanceLog::~MaintenanceLog() = default;

std::vector<RefusedMaintenance> MaintenanceLog::add(std::span<const MaintenanceEntry> entries) {
  const std::vector<std::string> parameters = entry_parameters(entries);
  return impl_->session.transact([&](Transaction& transaction) {
    std::vector<RefusedMaintenance> refused;
    for (const pqxx::row& row :
         transaction.run(kRefuseMaintenance, {parameters.begin(), parameters.begin() + 4})) {
      refused.push_back({row["place"].as<std::size_t>() - 1, refusal_of(read_text(row["reason"]))});
    }
    if (refused.empty()) transaction.run(kAddMaintenance, parameters);
    return refused;
  });
}

std::vector<MaintenanceRow> MaintenanceLog::list(const std::optional<std::string>& loop_name) {
  ArrayLiteral names;
  if (loop_name) names.add_text(*loop_name);
  return impl_->session.transact([&](Transaction& transaction) {
    std::vector<MaintenanceRow> rows;
    for (const pqxx::row& row :
         transaction.run(kListMaintenance, {loop_name ? "t" : "f", names.text()})) {
      rows.push_back(read_maintenance(row));
    }
    return rows;
  });
}

}  // namespace loopscope::storage
