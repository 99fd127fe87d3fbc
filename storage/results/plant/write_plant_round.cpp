#include "storage/results/plant/write_plant_round.hpp"

#include <algorithm>

#include "storage/array_literal.hpp"
#include "storage/results/plant/plant_picture.hpp"
#include "storage/results/session/session.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

const Statement kWritePlantRound{"write_plant_round", R"(
    INSERT INTO loopscope.plant_round AS kept
      (slot_end, algorithm_revision, loops, oscillating, events)
    VALUES ($1::timestamptz, $2::integer, $3::integer, $4::integer, $5::integer)
    ON CONFLICT (slot_end, algorithm_revision) DO UPDATE SET
      loops = EXCLUDED.loops, oscillating = EXCLUDED.oscillating, events = EXCLUDED.events,
      found_at = now())",
                                 Rows::none};

const Statement kWritePlantEvent{"write_plant_event", R"(
    INSERT INTO loopscope.plant_oscillation
      (slot_end, algorithm_revision, number, period_s, loop_ids, strengths, lags_s,
       source_loop_id, statement, roles, scores, p, outside, reasons, leads, traces)
    VALUES ($1::timestamptz, $2::integer, $3::integer, $4::float8, $5::bigint[], $6::float8[],
            $7::float8[], nullif($8, '')::bigint, $9, $10::text[], $11::float8[],
            nullif($12, '')::float8, nullif($13, '')::float8, $14::text[], $15::jsonb, $16::jsonb)
    ON CONFLICT (slot_end, algorithm_revision, number) DO UPDATE SET
      period_s = EXCLUDED.period_s, loop_ids = EXCLUDED.loop_ids, strengths = EXCLUDED.strengths,
      lags_s = EXCLUDED.lags_s, source_loop_id = EXCLUDED.source_loop_id,
      statement = EXCLUDED.statement, roles = EXCLUDED.roles, scores = EXCLUDED.scores,
      p = EXCLUDED.p, outside = EXCLUDED.outside, reasons = EXCLUDED.reasons,
      leads = EXCLUDED.leads, traces = EXCLUDED.traces, found_at = now())",
                                 Rows::none};

std::vector<const PlantEvent*> by_size(const std::vector<PlantEvent>& events) {
  std::vector<const PlantEvent*> sorted;
  for (const PlantEvent& event : events) sorted.push_back(&event);
  std::ranges::stable_sort(sorted, std::ranges::greater{},
                           [](const PlantEvent* event) { return event->members.size(); });
  return sorted;
}

/// One a line.
std::string lines_of(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : "\n") + sentence;
  return text;
}

void write_event(Transaction& transaction, const PlantRoundRecord& round, std::size_t number,
                 const PlantEvent& event) {
  ArrayLiteral loop_id, strength, lag_s, role, score, reasons;
  for (const PlantMember& member : event.members) {
    loop_id.add_integer(member.loop_id);
    strength.add_number(member.strength);
    lag_s.add_number(member.lag_s);
    role.add_text(member.role);
    score.add_number(member.score);
    reasons.add_text(lines_of(member.reasons));
  }
  transaction.run(
      kWritePlantEvent,
      {timestamp_text(round.slot_end_us), std::to_string(round.algorithm_revision),
       std::to_string(number), number_text(event.period_s), loop_id.text(), strength.text(),
       lag_s.text(), event.source_loop_id ? std::to_string(*event.source_loop_id) : "",
       make_storable(event.statement), role.text(), score.text(),
       event.p ? number_text(*event.p) : "", event.outside ? number_text(*event.outside) : "",
       reasons.text(), leads_json(event.leads), traces_json(event.traces)});
}

}  // namespace

void write_plant_round(Transaction& transaction, const PlantRoundRecord& round) {
  transaction.run(kWritePlantRound,
                  {timestamp_text(round.slot_end_us), std::to_string(round.algorithm_revision),
                   std::to_string(round.loops), std::to_string(round.oscillating),
                   std::to_string(round.events.size())});
  std::size_t number = 0;
  for (const PlantEvent* event : by_size(round.events)) {
    write_event(transaction, round, ++number, *event);
  }
}

}  // namespace loopscope::storage
