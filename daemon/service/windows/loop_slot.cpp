#include "daemon/service/windows/loop_slot.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/signal/microseconds.hpp"
#include "daemon/catalogue/entry_fields.hpp"

namespace loopscope::daemon {
namespace {

using storage::ClaimedLoop;
using storage::HistorianReader;
using storage::TagRequest;

/// Rows in the future that are counted at most: the sender's clock is wrong, whatever their number.
constexpr std::int64_t kFutureRows = 100;
/// As far ahead as a stamp may lie: beyond it the time types of some columns end.
constexpr std::int64_t kFutureReachUs = std::int64_t{100} * 366 * 86'400 * 1'000'000;

/// All tags of all claims, in the order of the claims and of kTagRoles.
std::vector<std::string> tags_of(std::span<const ClaimedLoop* const> claims) {
  std::vector<std::string> tags;
  for (const ClaimedLoop* claim : claims) {
    for (const TagRole& role : kTagRoles) {
      if (!(claim->loop.*role.tag).empty()) tags.push_back(claim->loop.*role.tag);
    }
  }
  return tags;
}

/// Clocks of sender and server differ a little: what lies within the settling time is not counted.
std::vector<std::size_t> future_rows(HistorianReader& historian,
                                     const std::vector<std::string>& tags, std::int64_t now_us,
                                     const SlotSettings& settings) {
  const std::int64_t from_us = now_us + core::signal::microseconds(settings.settle_s) + 1;
  std::vector<TagRequest> requests;
  requests.reserve(tags.size());
  for (const std::string& tag : tags) {
    requests.push_back(
        {tag, from_us, now_us + kFutureReachUs, kFutureRows, storage::RowBefore::no});
  }
  std::vector<std::size_t> counts;
  for (const auto& series : historian.read(requests)) counts.push_back(series.time_us.size());
  return counts;
}

/// Without any sample, the newest sample is the loop's registration, so that a second pass of
/// `once` finds the same slot; but no slot lies ahead.
std::int64_t slot_end(const ClaimedLoop& claim, const TagReadings& tags, std::int64_t now_us,
                      const SlotSettings& settings) {
  const std::int64_t settle_us = core::signal::microseconds(settings.settle_s);
  std::int64_t end = claim.database_now_us - settle_us;
  if (settings.rule == SlotRule::newest_sample) {
    const TagReading* pv = find_reading(tags, "pv");
    const auto newest = pv == nullptr ? std::nullopt : pv->newest_row_us;
    end = std::min(newest ? std::min(*newest, now_us - settle_us) : claim.loop.registered_us, end);
  }
  const std::int64_t newest = floor_to_period(end, claim.loop.period_s);
  if (settings.rule == SlotRule::newest_sample) return newest;
  return slot_to_analyse(newest, claim.last_slot_end_us, claim.loop.period_s, settings.catch_up);
}

}  // namespace

std::vector<LoopSlot> newest_slots(HistorianReader& historian,
                                   std::span<const ClaimedLoop* const> claims,
                                   const SlotSettings& settings, std::int64_t now_us) {
  const std::vector<std::string> tags = tags_of(claims);
  const auto newest = historian.newest(tags, now_us);
  const std::vector<std::size_t> future = future_rows(historian, tags, now_us, settings);
  std::vector<LoopSlot> slots;
  std::size_t next = 0;
  for (const ClaimedLoop* claim : claims) {
    LoopSlot& slot = slots.emplace_back();
    slot.loop = &claim->loop;
    slot.pv_past = claim->pv_past;
    for (const TagRole& role : kTagRoles) {
      if ((claim->loop.*role.tag).empty()) continue;
      slot.tags.push_back({role.name, newest[next], now_us, future[next], 0, 0, 0, 0});
      ++next;
    }
    slot.end_us = slot_end(*claim, slot.tags, now_us, settings);
  }
  return slots;
}

std::vector<LoopSlot> claimed_past_slots(storage::HistorianReader& historian,
                                         std::span<const ClaimedLoop* const> claims) {
  std::vector<TagRequest> requests;
  for (const ClaimedLoop* claim : claims) {
    const std::int64_t end_us = claim->past->end_us;
    const std::int64_t period_us = core::signal::microseconds(claim->loop.period_s);
    requests.push_back(
        {claim->loop.pv_tag, end_us, end_us + period_us - 1, 1, storage::RowBefore::no});
  }
  const std::vector<core::signal::RawSeries> rows = historian.read(requests);
  std::vector<LoopSlot> slots;
  for (std::size_t k = 0; k < claims.size(); ++k) {
    LoopSlot& slot = slots.emplace_back(past_slot(claims[k]->loop, claims[k]->past->end_us));
    slot.pv_past = claims[k]->pv_past;
    if (rows[k].time_us.empty()) {
      for (TagReading& tag : slot.tags) tag.newest_row_us = std::nullopt;
    }
  }
  return slots;
}

LoopSlot past_slot(const storage::CatalogueEntry& loop, std::int64_t slot_end_us) {
  LoopSlot slot{&loop, slot_end_us, {}};
  for (const TagRole& role : kTagRoles) {
    if ((loop.*role.tag).empty()) continue;
    TagReading reading;
    reading.role = role.name;
    reading.newest_row_us = slot_end_us;
    slot.tags.push_back(reading);
  }
  return slot;
}

}  // namespace loopscope::daemon
