#include "daemon/service/batches/fetch_windows.hpp"

#include <chrono>

#include "daemon/service/windows/newest_slots.hpp"

namespace loopscope::daemon {

std::vector<LoopTask> visit_newest(storage::HistorianReader& historian,
                                   std::span<const storage::ClaimedLoop* const> claims,
                                   const config::Settings& settings, const SourceTime& time,
                                   RowMemory& memory, const AnalysisContext& place) {
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const auto start = std::chrono::steady_clock::now();
  const auto slots = newest_slots(
      historian, claims, {settings.schedule.settle_s, time.rule, settings.schedule.catch_up_slots},
      time.now_us);
  std::vector<LoopInput> inputs = read_inputs(historian, slots, settings.analysis, memory, place);
  double reading_ms = Milliseconds(std::chrono::steady_clock::now() - start).count();
  for (const LoopInput& input : inputs) reading_ms -= input.first_look_ms;
  std::vector<LoopTask> visits;
  for (std::size_t k = 0; k < claims.size(); ++k) {
    visits.push_back(
        {claims[k], std::move(inputs[k]), {}, reading_ms / static_cast<double>(claims.size())});
  }
  return visits;
}

std::vector<std::pair<std::int64_t, std::int64_t>> slots_that_may_be_stored(
    std::span<const LoopTask> visits, int horizon) {
  std::vector<std::pair<std::int64_t, std::int64_t>> keys;
  for (const LoopTask& visit : visits) {
    const std::int64_t newest = visit.newest.at_slot.slot_end_us;
    const storage::ClaimedLoop& claim = *visit.claim;
    keys.emplace_back(claim.loop.loop_id, newest);
    for (const std::int64_t end :
         earlier_slots(newest, claim.last_slot_end_us, claim.loop.period_s, horizon)) {
      keys.emplace_back(claim.loop.loop_id, end);
    }
  }
  return keys;
}

EarlierSlots earlier_slots_to_check(std::span<const LoopTask> visits, const StoredAnalyses& stored,
                                    int horizon) {
  EarlierSlots earlier;
  for (std::size_t k = 0; k < visits.size(); ++k) {
    const LoopWindowAtSlot& newest = visits[k].newest.at_slot;
    const storage::ClaimedLoop& claim = *visits[k].claim;
    for (const std::int64_t end : slots_to_check(claim, newest.slot_end_us, stored, horizon)) {
      earlier.slots.push_back({&claim.loop, end, newest.tags, claim.pv_past});
      earlier.visit.push_back(k);
    }
  }
  return earlier;
}

void visit_earlier(storage::HistorianReader& historian, const EarlierSlots& earlier,
                   const config::Settings& settings, RowMemory& memory,
                   const AnalysisContext& place, std::span<LoopTask> visits) {
  std::vector<LoopInput> inputs =
      read_inputs(historian, earlier.slots, settings.analysis, memory, place);
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    visits[earlier.visit[k]].earlier.push_back(std::move(inputs[k]));
  }
}

}  // namespace loopscope::daemon
