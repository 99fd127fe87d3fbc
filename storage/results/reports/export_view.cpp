#include "storage/results/reports/export_view.hpp"

#include "storage/results/rows/loop_row.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/snapshot.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

constexpr ExportedView kViews[] = {
    {"annotation_history", "entered_at", true, "annotation that was ever made"},
    {"annotation_in_force", "entered_at", true, "annotation that holds"},
    {"before_after_maintenance", "done_at", true, "repair: before and after it"},
    {"current_plant_oscillation", "", false, "oscillation that loops share now"},
    {"data_problem", "since", true, "problem of a loop's newest data"},
    {"data_quality", "slot_end", true, "loop: what its newest data are worth"},
    {"explanation", "slot_end", true, "effect in the loop model of the newest window"},
    {"flag_history", "flagged_at", true, "stay of a loop on the list"},
    {"flagged_loop", "slot_end", true, "loop that needs action, worst first"},
    {"following_loop", "", true, "loop that follows a shared oscillation"},
    {"hidden_loop", "entered_at", true, "fault that is hidden, and by what"},
    {"latest_verdict", "slot_end", true, "loop: its newest verdict"},
    {"loop_history", "slot_end", true, "verdict that was ever given"},
    {"maintenance_figure", "", false, "figure before and after a repair, with intervals"},
    {"monitor_health", "last_slot_end", true, "loop: whether the monitor does its work there"},
    {"own_verdict", "slot_end", true, "loop: its newest verdict by its own window alone"},
    {"plant_oscillation_member", "slot_end", true, "loop in a shared oscillation"},
    {"revised_verdict", "revised_at", true, "verdict that late rows have changed"},
    {"service_factor", "slot_end", true,
     "loop: whether a controller acts, and how much of the time"},
    {"stage_breakdown", "hour", false, "hour and host: where the time went"},
    {"verdict_cause", "slot_end", true, "verdict and cause: how probable it is"},
    {"verdict_kind", "", false, "verdict and what it means"},
};

// pg_type.oid
constexpr pqxx::oid kBoolean = 16, kTextList = 1009, kTime = 1184;

std::string conditions(const ExportRequest& request) {
  std::string where;
  if (!request.loop_name.empty()) where += " AND loop_name = $1";
  if (request.since_us) {
    where += std::string(" AND ") + request.view->time_column +
             (request.loop_name.empty() ? " >= $1" : " >= $2") + "::timestamptz";
  }
  return where;
}

std::vector<std::string> parameters_of(const ExportRequest& request) {
  std::vector<std::string> parameters;
  if (!request.loop_name.empty()) parameters.push_back(make_storable(request.loop_name));
  if (request.since_us) parameters.push_back(timestamp_text(*request.since_us));
  return parameters;
}

/// The name of the view comes from the list above alone.
Statement select(const ExportRequest& request, const char* what) {
  return {"export_view", std::string("SELECT ") + what + " FROM loopscope." + request.view->name +
                             " AS shown WHERE true" + conditions(request)};
}

/// "2026-01-31 12:00:00.5+00" to "2026-01-31T12:00:00.5Z"; infinities stay.
std::string iso_time(std::string text) {
  const std::size_t blank = text.find(' ');
  if (blank == std::string::npos || !text.ends_with("+00")) return text;
  text[blank] = 'T';
  return text.substr(0, text.size() - 3) + "Z";
}

std::string joined(const std::vector<std::string>& texts) {
  std::string line;
  for (const std::string& text : texts) line += (line.empty() ? "" : "; ") + text;
  return line;
}

ExportedValue value_of(const pqxx::field& field) {
  if (field.is_null()) return std::nullopt;
  switch (field.type()) {
    case kBoolean:
      return field.as<bool>() ? "true" : "false";
    case kTextList:
      return joined(read_text_list(field));
    case kTime:
      return iso_time(field.c_str());
    default:
      return field.c_str();
  }
}

std::vector<std::string> names_of(const pqxx::result& rows) {
  std::vector<std::string> names;
  for (pqxx::row::size_type column = 0; column < rows.columns(); ++column) {
    names.emplace_back(rows.column_name(column));
  }
  return names;
}

/// `take` gets batch after batch, the first one even when it is empty.
template <typename Take>
void read_batches(const ConnectionSettings& settings, const ExportRequest& request,
                  const char* what, Take take) {
  Session session(settings);
  require_schema_version(session);
  Snapshot snapshot(session);
  snapshot.run_by_pieces(select(request, what), parameters_of(request), take);
}

}  // namespace

std::span<const ExportedView> exported_views() {
  return kViews;
}

void export_rows(const ConnectionSettings& settings, const ExportRequest& request,
                 const ExportedHeader& header, const ExportedRow& row) {
  bool first = true;
  read_batches(settings, request, "*", [&](const pqxx::result& rows) {
    if (first) header(names_of(rows));
    first = false;
    std::vector<ExportedValue> values;
    for (const pqxx::row& line : rows) {
      values.clear();
      for (const pqxx::field& field : line) values.push_back(value_of(field));
      row(values);
    }
  });
}

void export_objects(const ConnectionSettings& settings, const ExportRequest& request,
                    const ExportedObject& object) {
  read_batches(settings, request, "row_to_json(shown)", [&](const pqxx::result& rows) {
    for (const pqxx::row& line : rows) object(line[0].c_str());
  });
}

}  // namespace loopscope::storage
