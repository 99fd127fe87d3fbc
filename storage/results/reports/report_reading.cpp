#include "storage/results/reports/report_reading.hpp"

#include <optional>

#include "storage/results/rows/loop_row.hpp"

namespace loopscope::storage {
namespace {

std::int64_t integer(const pqxx::field& field) {
  return field.as<std::int64_t>();
}

RepairFigure read_figure(const pqxx::row& row) {
  return {row["figure"].c_str(),          read_text(row["unit"]),
          read_text(row["meaning"]),      read_number(row["before"]),
          read_number(row["before_low"]), read_number(row["before_high"]),
          read_number(row["after"]),      read_number(row["after_low"]),
          read_number(row["after_high"]), row["is_ratio"].as<bool>(),
          read_number(row["change"]),     read_number(row["change_low"]),
          read_number(row["change_high"])};
}

/// Without its figures.
RepairRow read_repair(const pqxx::row& row) {
  return {integer(row["maintenance_event_id"]),
          integer(row["loop_id"]),
          row["loop_name"].c_str(),
          integer(row["done_at_us"]),
          row["kind"].c_str(),
          row["description"].c_str(),
          maybe_text(row["word"]),
          read_text(row["statement"]),
          maybe_text(row["code_before"]),
          maybe_text(row["code_after"]),
          {},
          read_integer(row["windows_before"]),
          read_integer(row["windows_after"]),
          read_text(row["author"]),
          maybe_text(row["on_behalf_of"])};
}

HiddenRow read_hidden(const pqxx::row& row) {
  return {row["hidden_by"].c_str(),
          read_text(row["reason"]),
          read_text(row["author"]),
          read_integer(row["entered_us"]).value_or(0),
          read_integer(row["until_us"]),
          read_integer(row["plant_oscillation_number"]),
          maybe_text(row["source_loop_name"]),
          maybe_text(row["on_behalf_of"])};
}

}  // namespace

PlantCounts read_counts(const pqxx::row& row) {
  PlantCounts counts;
  counts.loops = integer(row["loops"]);
  counts.enabled = integer(row["enabled"]);
  counts.judged = integer(row["judged"]);
  counts.fixed = integer(row["fixed"]);
  counts.unjudgeable = integer(row["unjudgeable"]);
  counts.never_analysed = integer(row["never_analysed"]);
  counts.not_controlling = integer(row["not_controlling"]);
  counts.service_factor = read_number(row["service_factor"]);
  counts.now_us = integer(row["now_us"]);
  return counts;
}

UnjudgedReason read_reason(const pqxx::row& row) {
  return {row["words"].c_str(), row["remedy"].c_str(), integer(row["loops"]),
          read_text_list(row["names"])};
}

NotControllingRow read_not_controlling(const pqxx::row& row) {
  return {integer(row["loop_id"]),       row["loop_name"].c_str(),
          maybe_text(row["area"]),       read_text(row["lost_by"]),
          read_integer(row["since_us"]), read_number(row["week_fraction"])};
}

FlaggedRow read_flagged(const pqxx::row& row) {
  FlaggedRow flagged;
  flagged.rank = integer(row["rank"]);
  flagged.loop_id = integer(row["loop_id"]);
  flagged.loop_name = row["loop_name"].c_str();
  flagged.source = row["source"].c_str();
  flagged.loop_type = maybe_text(row["loop_type"]);
  flagged.area = maybe_text(row["area"]);
  flagged.unit = maybe_text(row["unit"]);
  flagged.description = maybe_text(row["description"]);
  flagged.pv_unit = read_text(row["pv_unit"]);
  flagged.code = row["code"].c_str();
  flagged.score = row["score"].as<double>();
  flagged.severity = row["severity"].as<double>();
  flagged.importance = row["importance"].as<double>();
  flagged.kind_weight = row["kind_weight"].as<double>();
  flagged.confidence = row["confidence"].as<double>();
  flagged.combined_confidence = read_number(row["combined_confidence"]);
  flagged.fault_probability = read_number(row["fault_probability"]);
  flagged.p = read_number(row["p"]);
  flagged.nonlinear_p = read_number(row["nonlinear_p"]);
  flagged.status = row["status"].c_str();
  flagged.since_us = integer(row["since_us"]);
  flagged.or_earlier = row["or_earlier"].as<bool>();
  flagged.slot_end_us = integer(row["slot_end_us"]);
  flagged.algorithm_revision = row["algorithm_revision"].as<int>();
  flagged.input_revision = row["input_revision"].as<int>();
  flagged.analysis_id = integer(row["analysis_id"]);
  flagged.summary = row["summary"].c_str();
  flagged.reasons = read_text_list(row["reasons"]);
  flagged.action = row["action"].c_str();
  flagged.ngi = read_number(row["ngi"]);
  flagged.nli = read_number(row["nli"]);
  flagged.oscillation_period_s = read_number(row["oscillation_period_s"]);
  flagged.harris_low = read_number(row["harris_low"]);
  flagged.harris_high = read_number(row["harris_high"]);
  flagged.plant_oscillation_number = read_integer(row["plant_oscillation_number"]);
  return flagged;
}

HistoryPoint read_history_point(const pqxx::row& row) {
  return {integer(row["slot_end_us"]),     row["code"].c_str(),
          row["confidence"].as<double>(),  read_number(row["ngi"]),
          read_number(row["nli"]),         read_number(row["nonlinear_p"]),
          read_number(row["error_std"]),   read_number(row["harris_low"]),
          read_number(row["harris_high"]), read_number(row["oscillation_period_s"])};
}

HiddenLoopRow read_hidden_loop(const pqxx::row& row) {
  return {integer(row["loop_id"]), row["loop_name"].c_str(), row["code"].c_str(), read_hidden(row),
          read_integer(row["annotation_id"])};
}

DataProblemRow read_problem(const pqxx::row& row) {
  return {row["problem"].c_str(),  read_text(row["role"]), read_text(row["tag"]),
          row["words"].c_str(),    row["remedy"].c_str(),  integer(row["since_us"]),
          row["judged"].as<bool>()};
}

std::vector<RepairRow> read_repairs(const pqxx::result& rows) {
  std::vector<RepairRow> repairs;
  for (const pqxx::row& row : rows) {
    if (repairs.empty() ||
        repairs.back().maintenance_event_id != integer(row["maintenance_event_id"])) {
      repairs.push_back(read_repair(row));
    }
    if (!row["figure"].is_null()) repairs.back().figures.push_back(read_figure(row));
  }
  return repairs;
}

}  // namespace loopscope::storage
