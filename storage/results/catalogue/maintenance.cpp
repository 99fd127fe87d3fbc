#include "storage/results/catalogue/maintenance.hpp"

#include "storage/array_literal.hpp"
#include "storage/results/rows/loop_row.hpp"
#include "storage/results/rows/statements.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {
namespace {

std::vector<std::string> entry_parameters(std::span<const MaintenanceEntry> entries) {
  ArrayLiteral loop_name, done_at, kind, description;
  for (const MaintenanceEntry& entry : entries) {
    loop_name.add_text(entry.loop_name);
    done_at.add_time(entry.done_at_us);
    kind.add_text(entry.kind);
    description.add_text(entry.description);
  }
  return {loop_name.text(), done_at.text(), kind.text(), description.text()};
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
                read_text(row["kind"]), read_text(row["description"])};
  if (!row["word"].is_null()) read.word = read_text(row["word"]);
  read.statement = read_text(row["statement"]);
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
    for (const pqxx::row& row : transaction.run(statements::kRefuseMaintenance, parameters)) {
      refused.push_back({row["place"].as<std::size_t>() - 1, refusal_of(read_text(row["reason"]))});
    }
    if (refused.empty()) transaction.run(statements::kAddMaintenance, parameters);
    return refused;
  });
}

std::vector<MaintenanceRow> MaintenanceLog::list(const std::optional<std::string>& loop_name) {
  ArrayLiteral names;
  if (loop_name) names.add_text(*loop_name);
  return impl_->session.transact([&](Transaction& transaction) {
    std::vector<MaintenanceRow> rows;
    for (const pqxx::row& row :
         transaction.run(statements::kListMaintenance, {loop_name ? "t" : "f", names.text()})) {
      rows.push_back(read_maintenance(row));
    }
    return rows;
  });
}

}  // namespace loopscope::storage
