#include "storage/results/catalogue/repair_judgements.hpp"

#include <cmath>
#include <map>
#include <string>

#include "core/diagnosis/diagnose.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "storage/array_literal.hpp"
#include "storage/results/catalogue/repair_statements.hpp"
#include "storage/results/rows/loop_row.hpp"
#include "storage/results/rows/number_list.hpp"
#include "storage/results/rows/text_list.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/session.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

using core::repair::FigureChange;
using core::repair::Interval;
using core::repair::RepairWindow;

/// Of a verdict that only a later program knows: none.
std::string family_of(const std::string& code) {
  const auto known = core::diagnosis::verdict_code(code);
  return known ? std::string(core::diagnosis::catalogue_entry(*known).family) : std::string();
}

DueRepair read_due(const pqxx::row& row) {
  DueRepair due;
  due.maintenance_event_id = row["maintenance_event_id"].as<std::int64_t>();
  due.newest_slot_end_us = read_integer(row["newest_slot_end_us"]);
  due.windows.min_confidence = row["min_confidence"].as<double>();
  due.windows.refused = read_text(row["unusable_reason"]);
  if (!row["newest_code"].is_null())
    due.windows.newest = {family_of(row["newest_code"].c_str()),
                          row["newest_confidence"].as<double>(), read_text(row["newest_slot"])};
  return due;
}

std::vector<core::repair::EffectParameter> read_effects(const pqxx::row& row) {
  const std::vector<std::string> effects = read_text_list(row["effects"]);
  const std::vector<std::string> parameters = read_text_list(row["parameters"]);
  const auto values = read_number_list(row["values"]);
  std::vector<core::repair::EffectParameter> read;
  for (std::size_t k = 0; k < effects.size(); ++k)
    read.push_back({effects[k], parameters.at(k), values.at(k).value()});
  return read;
}

RepairWindow read_window(const pqxx::row& row) {
  RepairWindow window;
  window.code = row["code"].c_str();
  window.family = family_of(window.code);
  window.confidence = row["confidence"].as<double>();
  window.error_std = read_number(row["error_std"]);
  window.error_log_variance_se = read_number(row["error_log_variance_se"]);
  window.harris = read_number(row["harris"]);
  window.ngi = read_number(row["ngi"]);
  window.nli = read_number(row["nli"]);
  window.nonlinear_p = read_number(row["nonlinear_p"]);
  window.oscillating = row["oscillating"].as<bool>();
  window.oscillation_amplitude = read_number(row["oscillation_amplitude"]);
  window.valve_travel_per_h = read_number(row["valve_travel_per_h"]);
  window.controller_gain = read_number(row["controller_gain"]);
  window.integral_time_s = read_number(row["integral_time_s"]);
  window.effects = read_effects(row);
  return window;
}

std::vector<DueRepair> read_all_due(Transaction& transaction, std::size_t limit) {
  std::vector<DueRepair> due;
  ArrayLiteral ids;
  std::map<std::int64_t, std::size_t> place;
  for (const pqxx::row& row :
       transaction.run(statements::kDueRepairs,
                       {std::to_string(core::kAlgorithmRevision), std::to_string(limit)})) {
    due.push_back(read_due(row));
    ids.add_integer(due.back().maintenance_event_id);
    place[due.back().maintenance_event_id] = due.size() - 1;
  }
  if (due.empty()) return due;
  for (const pqxx::row& row : transaction.run(statements::kRepairWindows, {ids.text()})) {
    core::repair::RepairWindows& windows =
        due.at(place.at(row["maintenance_event_id"].as<std::int64_t>())).windows;
    (std::string(row["side"].c_str()) == "before" ? windows.before : windows.after)
        .push_back(read_window(row));
  }
  return due;
}

std::string json_number(double value) {
  // JSON has no infinity: the exponential of an interval may be one.
  return std::isfinite(value) ? number_text(value) : "null";
}

std::string interval_json(const std::string& name, const std::optional<Interval>& interval) {
  const auto field = [&](const char* end, double Interval::*part) {
    return ",\"" + name + end + "\":" + (interval ? json_number((*interval).*part) : "null");
  };
  return field("", &Interval::value) + field("_low", &Interval::low) +
         field("_high", &Interval::high);
}

/// As the view maintenance_figure takes them apart.
std::string figure_json(const FigureChange& figure) {
  return "\"" + std::string(figure.kind->name) +
         "\":{\"n_before\":" + std::to_string(figure.windows_before) +
         ",\"n_after\":" + std::to_string(figure.windows_after) +
         ",\"is_ratio\":" + (figure.kind->is_ratio ? "true" : "false") +
         interval_json("before", figure.before) + interval_json("after", figure.after) +
         interval_json("change", figure.change) + "}";
}

std::string figures_json(std::span<const FigureChange> figures) {
  std::string json = "{";
  for (const FigureChange& figure : figures)
    json += (json.size() > 1 ? "," : "") + figure_json(figure);
  return json + "}";
}

std::string code_of(const std::optional<core::repair::StandingFault>& fault) {
  return fault ? fault->code : "";
}

std::vector<std::string> parameters_of(const JudgedRepair& judged) {
  const core::repair::RepairJudgement& judgement = judged.judgement;
  const auto variance = judgement.variance_ratio();
  const auto squared = [&](double Interval::*part) {
    return variance && std::isfinite((*variance).*part) ? number_text((*variance).*part) : "";
  };
  return {std::to_string(judged.repair.maintenance_event_id),
          std::to_string(core::kAlgorithmRevision),
          judged.repair.newest_slot_end_us ? timestamp_text(*judged.repair.newest_slot_end_us) : "",
          number_text(judged.repair.windows.min_confidence),
          judgement.outcome ? std::string(core::repair::name(*judgement.outcome)) : "",
          make_storable(judgement.statement),
          std::to_string(judgement.windows_before),
          std::to_string(judgement.windows_after),
          code_of(judgement.fault_before),
          code_of(judgement.fault_after),
          squared(&Interval::value),
          squared(&Interval::low),
          squared(&Interval::high),
          figures_json(judgement.figures)};
}

}  // namespace

struct RepairJudgements::Impl {
  explicit Impl(const ConnectionSettings& settings) : session(settings) {
    require_schema_version(session);
  }
  Session session;
};

RepairJudgements::RepairJudgements(const ConnectionSettings& settings)
    : impl_(std::make_unique<Impl>(settings)) {}
RepairJudgements::~RepairJudgements() = default;

std::vector<DueRepair> RepairJudgements::due(std::size_t limit) {
  return impl_->session.transact(
      [&](Transaction& transaction) { return read_all_due(transaction, limit); });
}

void RepairJudgements::store(std::span<const JudgedRepair> judged) {
  impl_->session.transact([&](Transaction& transaction) {
    for (const JudgedRepair& repair : judged)
      transaction.run(statements::kStoreRepairJudgement, parameters_of(repair));
  });
}

}  // namespace loopscope::storage
