#include "storage/results/reports/report_database.hpp"

#include <algorithm>

#include "storage/array_literal.hpp"
#include "storage/results/reports/count_lists.hpp"
#include "storage/results/reports/list_loops.hpp"
#include "storage/results/reports/plant_reading.hpp"
#include "storage/results/reports/plant_report_statements.hpp"
#include "storage/results/reports/report_reading.hpp"
#include "storage/results/reports/report_statements.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/snapshot.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

template <typename Read>
auto read_all(const pqxx::result& rows, Read read) {
  std::vector<decltype(read(rows[0]))> values;
  values.reserve(rows.size());
  for (const pqxx::row& row : rows) values.push_back(read(row));
  return values;
}

std::string threshold_text(std::optional<double> value) {
  return value ? number_text(*value) : "";
}

}  // namespace

struct ReportDatabase::Impl {
  explicit Impl(const ConnectionSettings& settings) : session(settings) {
    require_schema_version(session);
    snapshot.emplace(session);
  }

  /// The list of this moment; asked once, because several questions need it.
  const std::vector<FlaggedRow>& flagged() {
    if (!list) list = read_all(snapshot->run(statements::kReportFlagged), read_flagged);
    return *list;
  }

  /// What is kept off it; asked once.
  const std::vector<HiddenLoopRow>& hidden() {
    if (!off_list) off_list = read_all(snapshot->run(statements::kHiddenLoops), read_hidden_loop);
    return *off_list;
  }

  Session session;
  std::optional<Snapshot> snapshot;
  std::optional<std::vector<FlaggedRow>> list;
  std::optional<std::vector<HiddenLoopRow>> off_list;
};

ReportDatabase::ReportDatabase(const ConnectionSettings& settings)
    : impl_(std::make_unique<Impl>(settings)) {}
ReportDatabase::~ReportDatabase() = default;
ReportDatabase::ReportDatabase(ReportDatabase&&) noexcept = default;
ReportDatabase& ReportDatabase::operator=(ReportDatabase&&) noexcept = default;

std::int64_t ReportDatabase::now_us() {
  return impl_->snapshot->run(statements::kReportNow)[0]["now_us"].as<std::int64_t>();
}

PlantCounts ReportDatabase::counts(std::int64_t since_us) {
  const pqxx::result rows =
      impl_->snapshot->run(statements::kReportCounts, {timestamp_text(since_us)});
  PlantCounts counts = read_counts(rows[0]);
  count_lists(impl_->flagged(), impl_->hidden(), since_us, counts);
  counts.reasons = read_all(impl_->snapshot->run(statements::kUnjudgedReasons), read_reason);
  counts.without_controller =
      read_all(impl_->snapshot->run(statements::kNotControlling), read_not_controlling);
  return counts;
}

std::vector<FlaggedRow> ReportDatabase::flagged() {
  return impl_->flagged();
}

std::vector<HistoryPoint> ReportDatabase::history(std::int64_t loop_id, std::int64_t from_us) {
  return read_all(impl_->snapshot->run(statements::kReportHistory,
                                       {std::to_string(loop_id), timestamp_text(from_us)}),
                  read_history_point);
}

std::vector<RepairRow> ReportDatabase::repairs(std::int64_t since_us) {
  return read_repairs(impl_->snapshot->run(statements::kReportRepairs, {timestamp_text(since_us)}));
}

std::vector<RepairRow> ReportDatabase::repairs_of(std::int64_t loop_id) {
  return read_repairs(impl_->snapshot->run(statements::kRepairsOfLoop, {std::to_string(loop_id)}));
}

std::vector<PlantOscillationRow> ReportDatabase::plant_oscillations() {
  auto events = read_plant_oscillations(impl_->snapshot->run(statements::kPlantMembers));
  if (events.empty()) return events;
  add_leads(events, impl_->snapshot->run(statements::kPlantLeads));
  add_traces(events, impl_->snapshot->run(statements::kPlantTraces));
  return events;
}

std::optional<FollowedRow> ReportDatabase::followed_by(std::int64_t loop_id) {
  const pqxx::result rows = impl_->snapshot->run(statements::kFollowed, {std::to_string(loop_id)});
  if (rows.empty()) return std::nullopt;
  return read_followed(rows[0]);
}

std::vector<HiddenLoopRow> ReportDatabase::hidden() {
  return impl_->hidden();
}

std::vector<DataProblemRow> ReportDatabase::data_problems(std::int64_t loop_id) {
  return read_all(impl_->snapshot->run(statements::kLoopProblems, {std::to_string(loop_id)}),
                  read_problem);
}

std::optional<FlaggedRow> ReportDatabase::latest(const std::string& loop_name) {
  const std::vector<FlaggedRow>& list = impl_->flagged();
  const auto found = std::ranges::find(list, loop_name, &FlaggedRow::loop_name);
  if (found != list.end()) return *found;
  return newest(loop_name);
}

std::optional<FlaggedRow> ReportDatabase::newest(const std::string& loop_name) {
  // A name that PostgreSQL refuses cannot be in the catalogue.
  if (!is_storable(loop_name)) return std::nullopt;
  const pqxx::result rows = impl_->snapshot->run(statements::kReportLatest, {loop_name});
  if (rows.empty()) return std::nullopt;
  return read_flagged(rows[0]);
}

ListedLoops ReportDatabase::loops() {
  return list_loops(*impl_->snapshot, impl_->flagged(), impl_->hidden());
}

std::string ReportDatabase::in_small_letters(const std::string& text) {
  if (!is_storable(text)) return {};
  return impl_->snapshot->run(statements::kSmallLetters, {text})[0]["text"].c_str();
}

std::vector<WhatIfRow> ReportDatabase::what_if(std::optional<double> false_discovery_rate,
                                               std::optional<int> dependence,
                                               std::optional<double> min_confidence) {
  return read_all(impl_->snapshot->run(statements::kWhatIf, {threshold_text(false_discovery_rate),
                                                             threshold_text(dependence),
                                                             threshold_text(min_confidence)}),
                  [](const pqxx::row& row) {
                    return WhatIfRow{read_flagged(row), row["change"].c_str()};
                  });
}

}  // namespace loopscope::storage
