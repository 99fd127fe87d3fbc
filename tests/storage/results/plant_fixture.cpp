#include "tests/storage/results/plant_fixture.hpp"

#include <charconv>
#include <functional>

namespace loopscope::storage {
namespace {

/// The shortest text that reads back as the same number.
std::string text(double value) {
  if (std::isnan(value)) return "NULL";
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string array(const std::vector<PlantLoop>& loops,
                  const std::function<std::string(const PlantLoop&)>& field,
                  const std::string& type) {
  std::string list;
  for (const PlantLoop& loop : loops) list += (list.empty() ? "" : ",") + field(loop);
  return "'{" + list + "}'::" + type + "[]";
}

std::string numbers(const std::vector<PlantLoop>& loops, double PlantLoop::*field) {
  return array(
      loops, [field](const PlantLoop& loop) { return text(loop.*field); }, "float8");
}

/// A table of the loops' figures to insert from.
std::string told(const std::vector<PlantLoop>& loops) {
  const auto code = [](const PlantLoop& loop) { return loop.code; };
  const auto hours = [](const PlantLoop& loop) { return std::to_string(loop.slot_hours); };
  return "CREATE TEMP TABLE told ON COMMIT DROP AS SELECT loop_id, row.*,"
         " timestamptz '2026-01-01 00:00:00+00' + hours * interval '1 h' AS slot_end FROM unnest(" +
         numbers(loops, &PlantLoop::p) + "," + array(loops, code, "text") + "," +
         numbers(loops, &PlantLoop::nonlinear_p) + "," + numbers(loops, &PlantLoop::oscillation_p) +
         "," + numbers(loops, &PlantLoop::harris_p) + "," + numbers(loops, &PlantLoop::confidence) +
         "," + array(loops, hours, "integer") +
         ") WITH ORDINALITY AS row (p, code, nonlinear_p, oscillation_p, harris_p, confidence,"
         " hours, k) JOIN loopscope.loop ON loop.name = (k - 1)::text;";
}

constexpr const char* kInsert =
    "INSERT INTO loopscope.analysis (loop_id, slot_end, algorithm_revision, fence,"
    " program_version, settings, input_digest, fetch_ms, analyse_ms, window_start, window_end,"
    " samples, interval_s, usable, flags, oscillating, nonlinear_p, oscillation_p, harris_p)"
    " SELECT loop_id, slot_end, 1, 1, '', '{}', '', 0, 0, slot_end, slot_end, 4096, 1,"
    "   code <> 'insufficient_data', '{}', true, nonlinear_p, oscillation_p, harris_p FROM told;"
    "INSERT INTO loopscope.verdict (loop_id, slot_end, algorithm_revision, input_revision,"
    " analysis_id, code, confidence, p, summary, reasons, action)"
    " SELECT loop_id, slot_end, 1, 1, k, code, confidence, p, '', '{}', '' FROM told;"
    "UPDATE loopscope.schedule SET result_slot_end = greatest(result_slot_end, told.slot_end)"
    " FROM told WHERE told.loop_id = schedule.loop_id;";

}  // namespace

void PlantTest::fill(const std::vector<PlantLoop>& loops) {
  const auto enabled = [](const PlantLoop& loop) { return loop.enabled ? "true" : "false"; };
  database->execute(
      "DELETE FROM loopscope.analysis; DELETE FROM loopscope.verdict; DELETE FROM loopscope.loop;"
      "INSERT INTO loopscope.loop (name, source, pv_tag, period_s, enabled)"
      " SELECT (k - 1)::text, 'main', 'PV', 3600, enabled FROM unnest(" +
      array(loops, enabled, "boolean") + ") WITH ORDINALITY AS row (enabled, k)");
  analyse_again(loops);
}

void PlantTest::analyse_again(const std::vector<PlantLoop>& loops) {
  database->execute("BEGIN;" + told(loops) + kInsert + "COMMIT; ANALYZE");
}

std::vector<bool> PlantTest::flagged(std::size_t loops) const {
  std::vector<bool> result(loops, false);
  for (const auto& row : database->rows("SELECT loop_name FROM loopscope.flagged_loop")) {
    result.at(std::stoul(row.at(0))) = true;
  }
  return result;
}

void PlantTest::set(const std::string& parameter, double value) const {
  database->execute("UPDATE loopscope.parameter SET value = " + text(value) + " WHERE name = '" +
                    parameter + "'");
}

}  // namespace loopscope::storage
