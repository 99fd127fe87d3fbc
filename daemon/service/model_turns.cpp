#include "daemon/service/model_turns.hpp"

#include <cmath>

namespace loopscope::daemon {
namespace {

constexpr double kMicrosecondsPerSecond = 1e6;

/// Neighbours in the catalogue have their turns in different slots, so that every slot has as many.
bool is_its_turn(const storage::CatalogueEntry& loop, std::int64_t slot_end_us, int every_slots) {
  const std::int64_t period_us = std::llround(loop.period_s * kMicrosecondsPerSecond);
  return (slot_end_us / period_us + loop.loop_id) % every_slots == 0;
}

bool was_healthy(const storage::ClaimedLoop& claim) {
  return claim.last_verdict.empty() || claim.last_verdict == "healthy" ||
         claim.last_verdict == "insufficient_data";
}

}  // namespace

ModelWish model_wish(const config::ScheduleSettings& schedule, std::size_t enabled_loops,
                     const storage::ClaimedLoop& claim, std::int64_t slot_end_us) {
  const bool small = enabled_loops <= static_cast<std::size_t>(schedule.model_all_up_to);
  const bool always = small || !was_healthy(claim) ||
                      is_its_turn(claim.loop, slot_end_us, schedule.model_every_slots);
  return always ? ModelWish::always : ModelWish::where_there_is_cause;
}

}  // namespace loopscope::daemon
