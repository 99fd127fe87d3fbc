#include "daemon/service/batches/model_turns.hpp"

#include <cmath>

#include "core/signal/microseconds.hpp"
#include "daemon/service/batches/data_problems.hpp"

namespace loopscope::daemon {
namespace {

/// Steele, Lea and Flood (2014): every bit of the number reaches every bit of the result.
std::uint64_t mixed(std::uint64_t number) {
  number += 0x9E3779B97F4A7C15U;
  number = (number ^ (number >> 30)) * 0xBF58476D1CE4E5B9U;
  number = (number ^ (number >> 27)) * 0x94D049BB133111EBU;
  return number ^ (number >> 31);
}

/// By lot, not in a fixed order: visits may skip slots in any rhythm, and every loop has to have
/// its turn all the same.
bool is_its_turn(const storage::CatalogueEntry& loop, std::int64_t slot_end_us, int every_slots) {
  const std::int64_t period_us = core::signal::microseconds(loop.period_s);
  const auto slot = static_cast<std::uint64_t>(slot_end_us / period_us);
  const std::uint64_t lot = mixed(slot ^ mixed(static_cast<std::uint64_t>(loop.loop_id)));
  return lot % static_cast<std::uint64_t>(every_slots) == 0;
}

/// What may be flagged. False discoveries are controlled over all loops at once, which a single
/// loop cannot know: a tenth of the rate is above where the control ends while fewer than a third
/// of the loops are at fault.
core::ModelTrigger may_be_flagged(const config::FlagSettings& flags) {
  constexpr double kShareOfRate = 0.1;
  return {kShareOfRate * flags.false_discovery_rate, flags.min_confidence};
}

/// Nothing was said of the loop for want of data: what was said before may still hold.
bool was_silent(const storage::LastVerdict& last) {
  return !shows_a_loop(last.code);
}

}  // namespace

ModelPolicy model_wish(const config::Settings& settings, std::size_t enabled_loops,
                       const storage::ClaimedLoop& claim, std::int64_t slot_end_us) {
  const config::ScheduleSettings& schedule = settings.schedule;
  const core::ModelTrigger cause = may_be_flagged(settings.flags);
  const auto& last = claim.last_verdict;
  const bool always =
      enabled_loops <= static_cast<std::size_t>(schedule.model_all_up_to) ||
      (last && (was_silent(*last) || cause.given_by(last->code, last->confidence, last->p))) ||
      is_its_turn(claim.loop, slot_end_us, schedule.model_every_slots);
  return {always ? std::nullopt : std::optional(cause)};
}

}  // namespace loopscope::daemon
