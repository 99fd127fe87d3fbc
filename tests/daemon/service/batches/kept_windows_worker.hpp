#pragma once

// A historian that answers as a real one does, and a worker process as far as kept windows go:
// what it reads, keeps and stores of a slot.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "daemon/service/batches/kept_windows.hpp"
#include "daemon/service/windows/slot.hpp"

namespace loopscope::daemon::kept_windows_tests {

using core::signal::Hold;
using core::signal::RawSeries;
using storage::RowBefore;
using storage::TagRequest;

inline constexpr std::int64_t kSecond_us = 1'000'000;
inline constexpr std::int64_t kWindow_s = 64;
inline constexpr std::int64_t kPeriod_s = 16;
inline constexpr std::int64_t kFirstSlot_s = 1'600'000'000;  // a multiple of the period
inline constexpr int kWholeReadEvery = 6;

/// A historian of tags sampled once a second, whose rows people and gateways change as they like.
class Archive {
 public:
  std::multimap<std::int64_t, double>& rows(const std::string& tag) { return tags_[tag]; }

  std::vector<RawSeries> read(std::span<const TagRequest> requests) {
    std::vector<RawSeries> answers;
    for (const TagRequest& request : requests) answers.push_back(answer(request));
    return answers;
  }

 private:
  RawSeries answer(const TagRequest& request) {
    RawSeries found;
    found.hold = request.tag.ends_with("OP") ? Hold::step : Hold::sample;
    const auto& rows = tags_[request.tag];
    const auto first = rows.lower_bound(request.from_us);
    const bool before = request.before == RowBefore::yes ||
                        (request.before == RowBefore::if_held && found.hold != Hold::sample);
    if (before && first != rows.begin()) add_largest_of(std::prev(first)->first, rows, found);
    for (auto row = first; row != rows.upper_bound(request.to_us); ++row) {
      found.time_us.push_back(row->first);
      found.value.push_back(row->second);
    }
    settle_ties(found);
    return found;
  }
  /// Of the row before a span one is given out, the one that counts.
  static void add_largest_of(std::int64_t time_us, const std::multimap<std::int64_t, double>& rows,
                             RawSeries& found) {
    const auto [first, end] = rows.equal_range(time_us);
    found.time_us.push_back(time_us);
    found.value.push_back(std::max_element(first, end, [](const auto& a, const auto& b) {
                            return a.second < b.second;
                          })->second);
  }
  /// As a historian does that has nothing to tell such rows apart.
  static void settle_ties(RawSeries& rows) {
    for (std::size_t k = 1; k < rows.time_us.size(); ++k) {
      for (std::size_t j = k;
           j > 0 && rows.time_us[j] == rows.time_us[j - 1] && rows.value[j] < rows.value[j - 1];
           --j)
        std::swap(rows.value[j], rows.value[j - 1]);
    }
  }
  std::map<std::string, std::multimap<std::int64_t, double>> tags_;
};

/// The requests of a slot's window, as read_windows() makes them.
inline std::vector<TagRequest> requests_of(const storage::CatalogueEntry& loop,
                                           std::int64_t end_us) {
  const std::int64_t from_us = end_us - kWindow_s * kSecond_us;
  return {{loop.sp_tag, from_us, end_us, 2 * kWindow_s, RowBefore::yes},
          {loop.pv_tag, from_us, end_us, 2 * kWindow_s, RowBefore::if_held},
          {loop.op_tag, from_us, end_us, 2 * kWindow_s, RowBefore::if_held}};
}

/// Short, so that a failure can be read.
inline std::string digest_of_rows(const std::vector<RawSeries>& tags) {
  std::uint64_t hash = tags.size();
  const auto add = [&hash](std::uint64_t word) {
    hash = (hash ^ word) * 1'099'511'628'211U;
    hash ^= hash >> 32U;
  };
  for (const RawSeries& rows : tags) {
    add(rows.time_us.size());
    for (const std::int64_t time_us : rows.time_us) add(static_cast<std::uint64_t>(time_us));
    for (const double value : rows.value) add(std::bit_cast<std::uint64_t>(value));
  }
  return fmt::format("{:x}", hash);
}

/// The results: loop and slot to the digest of what its analysis was made of.
using Results = std::map<std::pair<std::int64_t, std::int64_t>, std::string>;

/// Two loops, the second a cascade's slave: its setpoint is the output of the first.
struct Loops {
  Loops() {
    for (std::int64_t id = 1; id <= 2; ++id) {
      storage::ClaimedLoop& claim = claims.emplace_back();
      claim.loop.loop_id = id;
      claim.loop.source = "plant";
      claim.loop.sp_tag = id == 1 ? "1.SP" : "1.OP";
      claim.loop.pv_tag = fmt::format("{}.PV", id);
      claim.loop.op_tag = fmt::format("{}.OP", id);
      claim.loop.interval_s = 1.0;
      claim.loop.period_s = kPeriod_s;
    }
  }
  std::vector<storage::ClaimedLoop> claims;
};

inline std::shared_ptr<const config::Settings> settings_with(int revise_slots) {
  auto settings = std::make_shared<config::Settings>();
  settings->historians.emplace_back().name = "plant";
  settings->schedule.revise_slots = revise_slots;
  settings->schedule.whole_read_every = kWholeReadEvery;
  settings->analysis.prepare.window_samples = kWindow_s;
  return settings;
}

/// One worker process: what it keeps, and how it does a slot.
struct Worker {
  explicit Worker(std::shared_ptr<const config::Settings> in_force)
      : settings(std::move(in_force)) {
    restart();
  }
  void restart() {
    cache = std::make_unique<WindowCache>();
    cache->limit(10'000'000);
  }

  /// Analyses the slot of all claims; returns the loops whose windows were read whole.
  std::set<std::int64_t> visit(std::span<storage::ClaimedLoop* const> loops, std::int64_t end_us,
                               Archive& archive, Results& results) {
    const std::vector<const storage::ClaimedLoop*> claims(loops.begin(), loops.end());
    KeptWindows kept(*cache, settings, settings_json);
    RowMemory memory;
    std::vector<LoopSlot> slots;
    for (const auto* claim : claims) slots.push_back(past_slot(claim->loop, end_us));
    const StoredAnalyses stored = stored_of(claims, results);
    kept.use(claims, slots, stored, memory);
    std::set<std::int64_t> whole;
    std::vector<storage::CompletedLoop> completed;
    std::vector<LoopTask> tasks;
    for (const auto* claim : claims) {
      if (memory.find(claim->loop.pv_tag, false) == nullptr) whole.insert(claim->loop.loop_id);
    }
    for (const auto* claim : claims) {
      storage::CompletedLoop& loop = completed.emplace_back();
      loop.loop_id = claim->loop.loop_id;
      loop.slot_end_us = end_us;
      loop.record.emplace().input_digest = digest(claim->loop, end_us, archive, memory);
      tasks.push_back({claim, {}, {}});
      tasks.back().newest.at_slot.window.sample_interval_s = 1.0;
    }
    kept.compare(memory);
    for (std::size_t k = 0; k < claims.size(); ++k)
      look_back(*claims[k], end_us, archive, memory, kept, stored, completed[k]);
    for (std::size_t k = 0; k < claims.size(); ++k) {
      kept.keep(tasks[k], completed[k], stored, memory);
      const std::int64_t id = completed[k].loop_id;
      results[{id, end_us}] = completed[k].record->input_digest;
      for (const auto& record : completed[k].revised)
        results[{id, record.slot_end_us}] = record.input_digest;
    }
    return whole;
  }

  std::shared_ptr<const config::Settings> settings;
  std::string settings_json = "{}";
  std::unique_ptr<WindowCache> cache;

 private:
  static std::string digest(const storage::CatalogueEntry& loop, std::int64_t end_us,
                            Archive& archive, RowMemory& memory) {
    return digest_of_rows(memory.read(requests_of(loop, end_us),
                                      [&](auto missing) { return archive.read(missing); }));
  }
  static StoredAnalyses stored_of(std::span<const storage::ClaimedLoop* const> claims,
                                  const Results& results) {
    std::vector<storage::StoredDigest> rows;
    for (const auto* claim : claims) {
      for (const auto& [key, digest] : results) {
        if (key.first == claim->loop.loop_id) rows.push_back({key.first, key.second, digest});
      }
    }
    return StoredAnalyses(rows);
  }
  void look_back(const storage::ClaimedLoop& claim, std::int64_t end_us, Archive& archive,
                 RowMemory& memory, const KeptWindows& kept, const StoredAnalyses& stored,
                 storage::CompletedLoop& completed) const {
    for (const std::int64_t end : earlier_slots(end_us, claim.last_slot_end_us, claim.loop.period_s,
                                                settings->schedule.revise_slots)) {
      const storage::StoredDigest* row = stored.find(claim.loop.loop_id, end);
      if (row == nullptr || kept.still_holds(claim, end, stored)) continue;
      storage::AnalysisRecord record;
      record.slot_end_us = end;
      record.input_digest = digest(claim.loop, end, archive, memory);
      if (record.input_digest != row->input_digest) completed.revised.push_back(record);
    }
  }
};

}  // namespace loopscope::daemon::kept_windows_tests
