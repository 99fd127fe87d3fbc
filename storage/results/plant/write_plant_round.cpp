#include "storage/results/plant/write_plant_round.hpp"

#include <algorithm>

#include "storage/array_literal.hpp"
#include "storage/results/plant/plant_picture_json.hpp"
#include "storage/results/plant/plant_statements.hpp"
#include "storage/results/session/session.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

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
      statements::kWritePlantEvent,
      {timestamp_text(round.slot_end_us), std::to_string(round.algorithm_revision),
       std::to_string(number), number_text(event.period_s), loop_id.text(), strength.text(),
       lag_s.text(), event.source_loop_id ? std::to_string(*event.source_loop_id) : "",
       make_storable(event.statement), role.text(), score.text(),
       event.p ? number_text(*event.p) : "", event.outside ? number_text(*event.outside) : "",
       reasons.text(), leads_json(event.leads), traces_json(event.traces)});
}

}  // namespace

void write_plant_round(Transaction& transaction, const PlantRoundRecord& round) {
  transaction.run(statements::kWritePlantRound,
                  {timestamp_text(round.slot_end_us), std::to_string(round.algorithm_revision),
                   std::to_string(round.loops), std::to_string(round.oscillating),
                   std::to_string(round.events.size())});
  std::size_t number = 0;
  for (const PlantEvent* event : by_size(round.events)) {
    write_event(transaction, round, ++number, *event);
  }
}

}  // namespace loopscope::storage
