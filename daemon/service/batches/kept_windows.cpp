#include "daemon/service/batches/kept_windows.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <functional>
#include <new>
#include <set>
#include <utility>

#include "core/signal/microseconds.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::RawSeries;
using storage::CatalogueEntry;

bool same_rows(const RawSeries& a, const RawSeries& b) {
  const auto same_bits = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  return a.hold == b.hold && a.time_us == b.time_us &&
         std::ranges::equal(a.value, b.value, same_bits);
}

/// Whether the rows of the common part of their spans are the same.
bool agree_in_common(const KnownRows& a, const KnownRows& b) {
  const std::int64_t from_us = std::max(a.from_us, b.from_us);
  const std::int64_t to_us = std::min(a.to_us, b.to_us);
  return same_rows(rows_within(a.rows, from_us, to_us), rows_within(b.rows, from_us, to_us));
}

/// How long what the newest slot's analysis reads is: the window, or the longer span.
std::int64_t span_us(const LoopInput& input, const core::AnalysisSettings& settings) {
  const std::size_t samples =
      std::max(settings.prepare.window_samples, input.first.slow_span_samples);
  return core::signal::microseconds(input.at_slot.window.sample_interval_s *
                                    static_cast<double>(samples));
}

/// All of the tags from a time up to the slot's end; empty where that is not known of all of them.
std::vector<KnownRows> all_known(const std::vector<TagKey>& tags, const RowMemory& memory,
                                 std::int64_t from_us, std::int64_t to_us) {
  std::vector<KnownRows> all;
  for (const auto& [tag, mode] : tags) {
    const KnownRows* rows = memory.find(tag, mode);
    if (rows == nullptr || rows->from_us > from_us || rows->to_us < to_us) return {};
    all.push_back(later_part(*rows, from_us, to_us));
  }
  return all;
}

/// A slot that moves by most of its window leaves little of it.
constexpr double kMostOfWindow = 0.5;

/// Rows that the next visit finds here instead of reading them, per hour.
double saved_rows_per_hour(const std::vector<KnownRows>& tags, double span_s, double period_s) {
  if (period_s > kMostOfWindow * span_s) return 0.0;
  double rows = 0.0;
  for (const KnownRows& tag : tags) rows += static_cast<double>(tag.rows.time_us.size());
  constexpr double kHour_s = 3600.0;
  return rows * (1.0 - period_s / span_s) * kHour_s / period_s;
}

}  // namespace

bool KeptWindows::keep_nothing() const {
  return settings_->schedule.whole_read_every == 1 || cache_->is_off();
}

/// Everything that goes into a digest beside the rows, and what makes windows of them.
std::size_t KeptWindows::facts_of(const CatalogueEntry& loop) const {
  const auto ends = [](const auto& range) {
    return range ? fmt::format("{} {}", range->low, range->high) : std::string("none");
  };
  return std::hash<std::string>{}(fmt::format("{}\n{}\n{}\n{}\n{}", *settings_json_, loop.loop_type,
                                              ends(loop.pv_range), ends(loop.op_range),
                                              loop.interval_s.value_or(0.0)));
}

/// Of the rows before the last slot's end: where no earlier slot is checked for late rows, the
/// newest sample alone, which may have been written while it was read.
std::int64_t KeptWindows::read_again_us(const KeptWindow& window,
                                        const CatalogueEntry& loop) const {
  const int slots = settings_->schedule.revise_slots;
  return core::signal::microseconds(slots > 0 ? slots * loop.period_s : window.sample_interval_s);
}

/// Whether these are the rows of the loop's last slot as it is stored. Where another worker has
/// been at work since, or has judged that slot by other rows, only the historian can tell.
bool KeptWindows::is_of(const KeptWindow& window, const storage::ClaimedLoop& claim,
                        const StoredAnalyses& stored) const {
  const std::int64_t end_us = window.slot_end_us;
  const storage::StoredDigest* row = stored.find(claim.loop.loop_id, end_us);
  const auto digest = window.digests.find(end_us);
  return claim.last_slot_end_us == end_us && row != nullptr && row->same_settings &&
         digest != window.digests.end() && digest->second == row->input_digest &&
         window.facts == facts_of(claim.loop) && window.is_of(claim.loop, *settings_);
}

/// Loops take turns, so that a plant's whole reads are spread over its slots.
bool KeptWindows::is_to_be_read_whole(const KeptWindow& window, const CatalogueEntry& loop,
                                      std::int64_t slot_end_us) const {
  const std::int64_t every = settings_->schedule.whole_read_every;
  const std::int64_t period_us = core::signal::microseconds(loop.period_s);
  return (slot_end_us / period_us + loop.loop_id) % every == 0 ||
         slot_end_us - window.whole_slot_end_us >= every * period_us;
}

std::optional<KeptWindows::Use> KeptWindows::use_of(const storage::ClaimedLoop& claim,
                                                    const LoopSlot& slot,
                                                    const StoredAnalyses& stored) const {
  auto window = cache_->find(claim.loop.loop_id);
  if (!window || slot.end_us <= window->slot_end_us || !is_of(*window, claim, stored) ||
      is_to_be_read_whole(*window, claim.loop, slot.end_us))
    return std::nullopt;
  Use use{std::move(window), 0, {}};
  use.fresh_from_us = use.window->slot_end_us - read_again_us(*use.window, claim.loop) + 1;
  try {
    for (const KeptTag& tag : use.window->tags) use.tags.push_back(known(tag));
  } catch (const std::bad_alloc&) {
    return std::nullopt;
  }
  return use;
}

/// Where loops share a tag and not all of them have the same rows of it, some rows are out of date,
/// and nobody knows whose.
void KeptWindows::drop_contradictory() {
  std::map<TagKey, std::vector<std::pair<std::int64_t, const KnownRows*>>> by_tag;
  for (const auto& [loop_id, use] : uses_) {
    for (std::size_t k = 0; k < use.tags.size(); ++k)
      by_tag[{use.window->tags[k].tag, use.window->tags[k].mode}].emplace_back(loop_id,
                                                                               &use.tags[k]);
  }
  std::set<std::int64_t> doubtful;
  for (const auto& [tag, loops] : by_tag) {
    const KnownRows& first = *loops.front().second;
    const bool agree = std::ranges::all_of(
        loops, [&](const auto& loop) { return agree_in_common(*loop.second, first); });
    if (agree) continue;
    for (const auto& [loop_id, rows] : loops) doubtful.insert(loop_id);
  }
  for (const std::int64_t loop_id : doubtful) uses_.erase(loop_id);
}

void KeptWindows::use(std::span<const storage::ClaimedLoop* const> claims,
                      std::span<const LoopSlot> slots, const StoredAnalyses& stored,
                      RowMemory& memory) {
  for (std::size_t k = 0; k < claims.size(); ++k) {
    auto use = use_of(*claims[k], slots[k], stored);
    if (use) uses_.emplace(claims[k]->loop.loop_id, std::move(*use));
  }
  drop_contradictory();
  std::set<TagKey> read_whole;  // a tag of several loops is, if one of them wants it
  for (const storage::ClaimedLoop* claim : claims) {
    if (uses_.contains(claim->loop.loop_id)) continue;
    const auto tags = tags_of(claim->loop);
    read_whole.insert(tags.begin(), tags.end());
  }
  for (const auto& [loop_id, use] : uses_) {
    for (std::size_t k = 0; k < use.tags.size(); ++k) {
      const KeptTag& tag = use.window->tags[k];
      const std::int64_t to_us = use.fresh_from_us - 1;
      if (to_us < tag.from_us || read_whole.contains({tag.tag, tag.mode})) continue;
      memory.know(tag.tag, tag.mode,
                  {tag.from_us, to_us, tag.before_known,
                   rows_within(use.tags[k].rows, kBeforeAll_us, to_us)});
    }
  }
}

void KeptWindows::compare(const RowMemory& memory) {
  for (auto& [loop_id, use] : uses_) {
    use.unchanged = true;
    for (std::size_t k = 0; k < use.tags.size(); ++k) {
      const KeptTag& tag = use.window->tags[k];
      const KnownRows* now = memory.find(tag.tag, tag.mode);
      use.unchanged = use.unchanged && now != nullptr && now->to_us >= tag.to_us &&
                      now->from_us <= use.fresh_from_us && agree_in_common(*now, use.tags[k]);
    }
    use.tags = {};
  }
}

bool KeptWindows::still_holds(const storage::ClaimedLoop& claim, std::int64_t slot_end_us,
                              const StoredAnalyses& stored) const {
  const auto found = uses_.find(claim.loop.loop_id);
  if (found == uses_.end() || !found->second.unchanged) return false;
  const storage::StoredDigest* row = stored.find(claim.loop.loop_id, slot_end_us);
  const auto& digests = found->second.window->digests;
  const auto digest = digests.find(slot_end_us);
  return row != nullptr && digest != digests.end() && digest->second == row->input_digest;
}

std::map<std::int64_t, std::string> KeptWindows::digests_of(const LoopTask& task,
                                                            const storage::CompletedLoop& completed,
                                                            const StoredAnalyses& stored) const {
  const std::int64_t loop_id = completed.loop_id;
  std::map<std::int64_t, std::string> digests;
  const auto note = [&](std::int64_t end_us) {
    if (const storage::StoredDigest* row = stored.find(loop_id, end_us))
      digests[end_us] = row->input_digest;
  };
  note(completed.slot_end_us);
  for (const LoopInput& input : task.earlier) note(input.at_slot.slot_end_us);
  if (const auto use = uses_.find(loop_id); use != uses_.end() && use->second.unchanged) {
    for (const auto& [end_us, digest] : use->second.window->digests) {
      if (still_holds(*task.claim, end_us, stored)) digests[end_us] = digest;
    }
  }
  if (completed.record) digests[completed.slot_end_us] = completed.record->input_digest;
  for (const storage::AnalysisRecord& record : completed.revised)
    digests[record.slot_end_us] = record.input_digest;
  return digests;
}

void KeptWindows::keep(const LoopTask& task, const storage::CompletedLoop& completed,
                       const StoredAnalyses& stored, const RowMemory& memory) const {
  if (keep_nothing() || task.claim->past) return;
  try {
    auto window = window_of(task, completed, stored, memory);
    if (window)
      return cache_->keep(completed.loop_id, std::move(*window), task.claim->database_now_us);
  } catch (const std::bad_alloc&) {
    // The analysis is done all the same.
  }
  cache_->forget(completed.loop_id);
}

std::optional<KeptWindow> KeptWindows::window_of(const LoopTask& task,
                                                 const storage::CompletedLoop& completed,
                                                 const StoredAnalyses& stored,
                                                 const RowMemory& memory) const {
  const storage::ClaimedLoop& claim = *task.claim;
  const std::int64_t loop_id = claim.loop.loop_id, end_us = completed.slot_end_us;
  const std::int64_t span = span_us(task.newest, settings_->analysis);
  const auto tags = tags_of(claim.loop);
  const auto rows = all_known(tags, memory, end_us - span, end_us);
  const double saved = saved_rows_per_hour(
      rows, static_cast<double>(span) / core::signal::kMicrosecondsPerSecond, claim.loop.period_s);
  if (!cache_->has_use_for(loop_id, saved)) return std::nullopt;
  KeptWindow window;
  window.settings = settings_;
  window.facts = facts_of(claim.loop);
  window.slot_end_us = end_us;
  window.sample_interval_s = task.newest.at_slot.window.sample_interval_s;
  const auto use = uses_.find(loop_id);
  window.whole_slot_end_us = use == uses_.end() ? end_us : use->second.window->whole_slot_end_us;
  window.digests = digests_of(task, completed, stored);
  for (std::size_t k = 0; k < tags.size(); ++k)
    window.tags.push_back(kept(tags[k].first, tags[k].second, rows[k]));
  window.saved_rows_per_hour = saved;
  // A visit may be late by one period and another.
  window.stale_us = claim.database_now_us + 3 * core::signal::microseconds(claim.loop.period_s);
  return window;
}

}  // namespace loopscope::daemon
