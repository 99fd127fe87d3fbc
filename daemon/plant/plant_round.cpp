#include "daemon/plant/plant_round.hpp"

#include <fmt/format.h>

#include "core/plant/event.hpp"
#include "core/plant/shared_oscillation.hpp"
#include "core/text/counted.hpp"
#include "daemon/plant/compared_loops.hpp"
#include "daemon/plant/event_record.hpp"

namespace loopscope::daemon {
namespace {

using core::plant::SharedOscillation;

/// Loops that are compared at most, those that oscillate first: with what the search makes of them
/// 18 kB each and up to as much for the envelopes of one frequency, all in memory together.
constexpr std::int64_t kMostLoops = 10000;

/// nullopt = the process shall end.
std::optional<storage::PlantRoundRecord> compare(ComparedLoops& compared, CoreGate& cores) {
  if (!compared.read_errors() || !compared.read_longer()) return std::nullopt;
  std::vector<core::plant::Event> events;
  {
    const CoreGate::Permit core(cores);
    events = core::plant::find_events(compared.records(), {});
  }
  storage::PlantRoundRecord round;
  round.loops = compared.read();
  round.oscillating = compared.oscillating();
  if (!compared.read_members(events)) return std::nullopt;
  const CoreGate::Permit core(cores);
  for (const SharedOscillation& shared :
       core::plant::explain_events(events, compared.loops(), compared.cascades()))
    round.events.push_back(event_record(shared, compared.loops()));
  return round;
}

}  // namespace

std::optional<storage::PlantRoundRecord> make_plant_round(storage::PlantRounds& rounds,
                                                          const config::Settings& settings,
                                                          SharedServices& tools) {
  const std::optional<std::int64_t> slot_end_us = rounds.newest_slot_us();
  if (!slot_end_us) return std::nullopt;
  ComparedLoops compared(rounds.candidates(*slot_end_us, kMostLoops), settings, tools);
  auto round = compare(compared, tools.cores);
  if (!round) return std::nullopt;
  round->slot_end_us = *slot_end_us;
  rounds.store(*round);
  return round;
}

std::string round_text(const storage::PlantRoundRecord& round) {
  std::string text = fmt::format(
      "{} compared, {} of them oscillating; {}", core::text::counted(round.loops, "loop", "loops"),
      round.oscillating,
      core::text::counted(round.events.size(), "shared oscillation", "shared oscillations"));
  for (const storage::PlantEvent& event : round.events) text += "; " + event.statement;
  return text;
}

}  // namespace loopscope::daemon
