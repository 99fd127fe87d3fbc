#include "daemon/plant/plant_round.hpp"

#include <atomic>
#include <fmt/format.h>
#include <utility>
#include <vector>

#include "core/plant/event.hpp"
#include "core/plant/shared_oscillation.hpp"
#include "core/text/counted.hpp"
#include "daemon/plant/compared_loops.hpp"
#include "daemon/plant/event_record.hpp"
#include "daemon/service/threads/memory.hpp"

namespace loopscope::daemon {
namespace {

using core::plant::SharedOscillation;

/// Loops that are compared at most, those that oscillate first: with what the search makes of them
/// 14 kB each and up to two thirds of that for the envelopes of one frequency, all in memory
/// together.
constexpr std::int64_t kMostLoops = 10000;

/// Says that loops are compared as long as it lives, and gives back what that took.
class Comparing {
 public:
  explicit Comparing(std::atomic<bool>& comparing) : comparing_(comparing) { comparing_ = true; }
  ~Comparing() {
    give_back_freed_memory();
    comparing_ = false;
  }
  Comparing(const Comparing&) = delete;
  Comparing& operator=(const Comparing&) = delete;

 private:
  std::atomic<bool>& comparing_;
};

/// nullopt = the process shall end.
std::optional<storage::PlantRoundRecord> compare(std::vector<storage::PlantCandidate> candidates,
                                                 const config::Settings& settings,
                                                 SharedServices& tools) {
  ComparedLoops compared(std::move(candidates), settings, tools);
  if (!compared.read_errors() || !compared.read_longer()) return std::nullopt;
  give_back_freed_memory();  // what reading took: now comes the most that the program ever holds
  std::vector<core::plant::Event> events;
  {
    const CoreGate::Permit core(tools.cores);
    events = core::plant::find_events(compared.records(), {});
  }
  storage::PlantRoundRecord round;
  round.loops = compared.read();
  round.oscillating = compared.oscillating();
  compared.keep_only(events);
  give_back_freed_memory();
  if (!compared.read_members(events)) return std::nullopt;
  const CoreGate::Permit core(tools.cores);
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
  const Comparing comparing(tools.comparing);
  auto round = compare(rounds.candidates(*slot_end_us, kMostLoops), settings, tools);
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
