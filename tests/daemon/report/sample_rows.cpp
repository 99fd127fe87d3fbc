#include "tests/daemon/report/sample_rows.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::int64_t kSlot = 1'772'366'400'000'000;  // 2026-03-01T12:00:00Z

}  // namespace

storage::FlaggedRow flagged_row(std::int64_t loop_id, const std::string& text) {
  storage::FlaggedRow row;
  row.rank = loop_id;
  row.loop_id = loop_id;
  row.loop_name = row.source = row.summary = row.action = text;
  row.loop_type = text;
  row.reasons = {text, text};
  row.code = "valve_stiction";
  row.score = 0.504;
  row.severity = 0.8;
  row.importance = 1.0;
  row.kind_weight = 1.0;
  row.confidence = 0.63;
  row.p = 1e-5;
  row.status = "confirmed";
  row.since_us = row.slot_end_us = kSlot;
  row.analysis_id = loop_id;
  row.plant_oscillation_number = 1;
  return row;
}

PlantFacts plant_facts(const std::string& text) {
  PlantFacts facts;
  facts.plant = text;
  facts.since_us = kSlot - 1;
  facts.counts = {
      .loops = 13,
      .enabled = 12,
      .judged = 9,
      .not_controlling = 1,
      .service_factor = 0.93,
      .flagged = 2,
      .new_flags = 1,
      .fixed = 3,
      .unjudgeable = 1,
      .never_analysed = 1,
      .victims = 4,
      .annotated = 5,
      .unlisted = 6,
      .reasons = {{text, text, 3, {text, "TIC9"}}},
      .without_controller = {{3, text, text, "mode", kSlot, 0.25}},
      .annotations = 7,
      .newest_annotations =
          {{4, text, "valve_stiction", {"acknowledged", text, text, kSlot, {}, {}, {}, text}},
           {5, text, "tight_tuning", {"suppressed", text, "eve", kSlot, kSlot, {}, {}}}},
      .now_us = kSlot};
  facts.flagged = {flagged_row(1, text), flagged_row(2, text)};
  facts.oscillations = {
      {.number = 1,
       .period_s = 120.0,
       .source_name = text,
       .statement = text,
       .members = {{1, text, "source", 0.8, 0.0, 3.0, {text, "Against it: " + text}}},
       .slot_end_us = kSlot,
       .p = 0.001,
       .outside = 0.1,
       .leads = {{1, 1, 0.5}}}};
  facts.repairs = {{.maintenance_event_id = 1,
                    .loop_id = 1,
                    .loop_name = text,
                    .done_at_us = kSlot,
                    .kind = "valve",
                    .description = text,
                    .word = "improved",
                    .statement = text,
                    .code_before = "valve_stiction",
                    .code_after = "healthy",
                    .figures = {{.name = "error_std",
                                 .unit = "pv units",
                                 .meaning = text,
                                 .before = 2.0,
                                 .before_low = 1.8,
                                 .before_high = 2.2,
                                 .after = 1.0,
                                 .after_low = 0.9,
                                 .after_high = 1.1,
                                 .is_ratio = true,
                                 .change = 0.5,
                                 .change_low = 0.44,
                                 .change_high = 0.57}}}};
  return facts;
}

storage::ListedLoops without_areas(const storage::ListedLoops& loops) {
  storage::ListedLoops rows;
  for (storage::LoopRow row : loops) {
    row.area.reset();
    rows.push_back(row);
  }
  return rows;
}

}  // namespace loopscope::daemon
