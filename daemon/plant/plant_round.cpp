#include "daemon/plant/plant_round.hpp"

#include <fmt/format.h>
#include <vector>

#include "core/diagnosis/plant_member.hpp"
#include "core/plant/shared_oscillation.hpp"
#include "daemon/plant/event_record.hpp"
#include "daemon/plant/plant_series.hpp"

namespace loopscope::daemon {
namespace {

using core::plant::MemberLoop;
using core::plant::SharedOscillation;

/// Loops that are compared at most, those that oscillate first: their windows lie in memory
/// together, 130 kB each.
constexpr std::int64_t kMostLoops = 2000;

/// Loops whose rows are gone are left out; the spans look into `series`.
std::vector<MemberLoop> loops_of(const std::vector<storage::PlantCandidate>& candidates,
                                 const std::vector<PlantSeries>& series) {
  std::vector<MemberLoop> loops;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const PlantSeries& one = series[k];
    if (one.error.empty()) continue;
    const storage::PlantCandidate& candidate = candidates[k];
    MemberLoop loop;
    loop.id = candidate.loop.loop_id;
    loop.name = candidate.loop.name;
    loop.sample_interval_s = one.sample_interval_s;
    loop.start_us = one.start_us;
    loop.error = one.error;
    loop.sp = one.sp;
    loop.pv = one.pv;
    loop.op = one.op;
    loop.oscillation = candidate.evidence.oscillation;
    loop.own = core::diagnosis::own_findings(candidate.evidence, candidate.verdict);
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::int64_t oscillating(const std::vector<MemberLoop>& loops) {
  std::int64_t count = 0;
  for (const MemberLoop& loop : loops) count += loop.oscillation.present ? 1 : 0;
  return count;
}

storage::PlantRoundRecord compare(std::int64_t slot_end_us, const std::vector<MemberLoop>& loops) {
  storage::PlantRoundRecord round;
  round.slot_end_us = slot_end_us;
  round.loops = static_cast<std::int64_t>(loops.size());
  round.oscillating = oscillating(loops);
  for (const SharedOscillation& shared : core::plant::find_shared_oscillations(loops))
    round.events.push_back(event_record(shared, loops));
  return round;
}

}  // namespace

std::optional<storage::PlantRoundRecord> make_plant_round(storage::PlantRounds& rounds,
                                                          const config::Settings& settings,
                                                          LaneTools& tools) {
  const std::optional<std::int64_t> slot_end_us = rounds.newest_slot_us();
  if (!slot_end_us) return std::nullopt;
  const auto candidates = rounds.candidates(*slot_end_us, kMostLoops);
  const auto series = read_plant_series(candidates, settings, tools);
  if (tools.bell.rung()) return std::nullopt;
  storage::PlantRoundRecord round;
  {
    const CoreGate::Permit core(tools.cores);
    round = compare(*slot_end_us, loops_of(candidates, series));
  }
  rounds.store(round);
  return round;
}

std::string round_text(const storage::PlantRoundRecord& round) {
  std::string text = fmt::format("{} loops compared, {} of them oscillate, {} share an oscillation",
                                 round.loops, round.oscillating, round.events.size());
  for (const storage::PlantEvent& event : round.events) text += "; " + event.statement;
  return text;
}

}  // namespace loopscope::daemon
