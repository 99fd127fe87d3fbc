#include "storage/results/reports/plant_reading.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "storage/results/rows/loop_row.hpp"

namespace loopscope::storage {
namespace {

/// One sentence a line.
std::vector<std::string> read_lines(const pqxx::field& field) {
  std::vector<std::string> lines;
  const std::string text = read_text(field);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// What is null was not recorded: NaN.
std::vector<double> read_series(const pqxx::field& field) {
  std::vector<double> series;
  for (const std::optional<double>& value : read_number_list(field))
    series.push_back(value.value_or(NAN));
  return series;
}

PlantOscillationRow::Member read_member(const pqxx::row& row) {
  return {row["loop_id"].as<std::int64_t>(),
          row["loop_name"].c_str(),
          row["role"].c_str(),
          read_number(row["strength"]).value_or(0.0),
          read_number(row["lag_s"]).value_or(0.0),
          read_number(row["score"]),
          read_lines(row["reasons"])};
}

PlantOscillationRow read_event(const pqxx::row& row) {
  PlantOscillationRow event;
  event.number = row["number"].as<std::int64_t>();
  event.period_s = row["period_s"].as<double>();
  event.source_name = maybe_text(row["source_loop_name"]);
  event.statement = row["statement"].c_str();
  event.slot_end_us = row["slot_end_us"].as<std::int64_t>();
  event.p = read_number(row["p"]);
  event.outside = read_number(row["outside"]);
  return event;
}

/// The event of a row; nullptr = there is none.
PlantOscillationRow* event_of(std::vector<PlantOscillationRow>& events, const pqxx::row& row) {
  const auto number = row["number"].as<std::int64_t>();
  const auto found = std::ranges::find(events, number, &PlantOscillationRow::number);
  return found == events.end() ? nullptr : &*found;
}

}  // namespace

std::vector<PlantOscillationRow> read_plant_oscillations(const pqxx::result& rows) {
  std::vector<PlantOscillationRow> events;
  for (const pqxx::row& row : rows) {
    if (events.empty() || events.back().number != row["number"].as<std::int64_t>())
      events.push_back(read_event(row));
    events.back().members.push_back(read_member(row));
  }
  return events;
}

void add_leads(std::vector<PlantOscillationRow>& events, const pqxx::result& rows) {
  for (const pqxx::row& row : rows)
    if (PlantOscillationRow* const event = event_of(events, row))
      event->leads.push_back({row["from_loop_id"].as<std::int64_t>(),
                              row["to_loop_id"].as<std::int64_t>(), row["gain"].as<double>(),
                              read_number(row["direct"]).value_or(0.0)});
}

void add_traces(std::vector<PlantOscillationRow>& events, const pqxx::result& rows) {
  for (const pqxx::row& row : rows)
    if (PlantOscillationRow* const event = event_of(events, row))
      event->traces.push_back({row["loop_id"].as<std::int64_t>(),
                               row["start_us"].as<std::int64_t>(), row["step_s"].as<double>(),
                               read_series(row["error"]), read_series(row["periods_s"]),
                               read_series(row["power"])});
}

FollowedRow read_followed(const pqxx::row& row) {
  return {row["number"].as<std::int64_t>(),    row["period_s"].as<double>(),
          maybe_text(row["source_loop_name"]), row["role"].c_str(),
          row["strength"].as<double>(),        row["shown_code"].c_str()};
}

}  // namespace loopscope::storage
