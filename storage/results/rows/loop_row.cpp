#include "storage/results/rows/loop_row.hpp"

#include <string>
#include <tuple>

namespace loopscope::storage {
namespace {

std::optional<core::signal::OpRange> read_range(const pqxx::row& row, const char* low_column,
                                                const char* high_column) {
  const std::optional<double> low = read_number(row[low_column]);
  const std::optional<double> high = read_number(row[high_column]);
  if (!low || !high) return std::nullopt;
  return core::signal::OpRange{*low, *high};
}

}  // namespace

std::optional<std::string> maybe_text(const pqxx::field& field) {
  if (field.is_null()) return std::nullopt;
  return field.c_str();
}

std::string read_text(const pqxx::field& field) {
  return field.is_null() ? "" : field.c_str();
}

std::optional<std::int64_t> read_integer(const pqxx::field& field) {
  if (field.is_null()) return std::nullopt;
  return field.as<std::int64_t>();
}

std::optional<double> read_number(const pqxx::field& field) {
  if (field.is_null()) return std::nullopt;
  return field.as<double>();
}

std::optional<core::signal::PvPast> read_pv_past(const pqxx::row& row) {
  const std::optional<double> flat_s = read_number(row["pv_flat_s"]);
  if (!flat_s) return std::nullopt;
  return core::signal::PvPast{*flat_s, read_number(row["pv_step"]).value_or(0.0)};
}

CatalogueEntry read_loop(const pqxx::row& row) {
  CatalogueEntry loop;
  loop.loop_id = row["loop_id"].as<std::int64_t>();
  loop.name = row["name"].c_str();
  loop.source = row["source"].c_str();
  loop.sp_tag = read_text(row["sp_tag"]);
  loop.pv_tag = row["pv_tag"].c_str();
  loop.op_tag = read_text(row["op_tag"]);
  loop.mv_tag = read_text(row["mv_tag"]);
  loop.mode_tag = read_text(row["mode_tag"]);
  loop.interval_s = read_number(row["interval_s"]);
  loop.period_s = row["period_s"].as<double>();
  loop.op_range = read_range(row, "op_low", "op_high");
  loop.pv_range = read_range(row, "pv_low", "pv_high");
  loop.loop_type = read_text(row["loop_type"]);
  loop.area = read_text(row["area"]);
  loop.unit = read_text(row["unit"]);
  loop.description = read_text(row["description"]);
  loop.pv_unit = read_text(row["pv_unit"]);
  loop.owner = read_text(row["owner"]);
  loop.importance = row["importance"].as<double>();
  loop.enabled = row["enabled"].as<bool>();
  loop.registered_us = row["registered_us"].as<std::int64_t>();
  return loop;
}

std::vector<std::optional<double>> read_number_list(const pqxx::field& field) {
  std::vector<std::optional<double>> values;
  if (field.is_null()) return values;
  pqxx::array_parser elements = field.as_array();
  for (auto [what, text] = elements.get_next(); what != pqxx::array_parser::done;
       std::tie(what, text) = elements.get_next()) {
    if (what == pqxx::array_parser::string_value)
      pqxx::from_string(text, values.emplace_back(0.0).value());
    else if (what == pqxx::array_parser::null_value)
      values.emplace_back(std::nullopt);
  }
  return values;
}

std::vector<std::string> read_text_list(const pqxx::field& field) {
  std::vector<std::string> texts;
  pqxx::array_parser elements = field.as_array();
  for (auto [what, text] = elements.get_next(); what != pqxx::array_parser::done;
       std::tie(what, text) = elements.get_next()) {
    if (what == pqxx::array_parser::string_value) texts.push_back(text);
  }
  return texts;
}

}  // namespace loopscope::storage
