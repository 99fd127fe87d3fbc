#include "daemon/service/batches/kept_windows.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>
#include <set>

#include "tests/support/long_run.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::Hold;
using core::signal::RawSeries;
using storage::RowBefore;
using storage::TagRequest;

constexpr std::int64_t kSecond_us = 1'000'000;
constexpr std::int64_t kWindow_s = 64;
constexpr std::int64_t kPeriod_s = 16;
constexpr std::int64_t kFirstSlot_s = 1'600'000'000;  // a multiple of the period
constexpr int kWholeReadEvery = 6;

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
std::vector<TagRequest> requests_of(const storage::CatalogueEntry& loop, std::int64_t end_us) {
  const std::int64_t from_us = end_us - kWindow_s * kSecond_us;
  return {{loop.sp_tag, from_us, end_us, 2 * kWindow_s, RowBefore::yes},
          {loop.pv_tag, from_us, end_us, 2 * kWindow_s, RowBefore::if_held},
          {loop.op_tag, from_us, end_us, 2 * kWindow_s, RowBefore::if_held}};
}

/// Short, so that a failure can be read.
std::string digest_of_rows(const std::vector<RawSeries>& tags) {
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

std::shared_ptr<const config::Settings> settings_with(int revise_slots) {
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

/// A plant whose rows come late, change, vanish and come twice, judged with and without kept
/// windows.
class History {
 public:
  explicit History(std::uint64_t seed)
      : random_(seed),
        settings_(settings_with(static_cast<int>(below(3)))),
        workers_{Worker(settings_), Worker(settings_)} {
    for (const char* tag : kTags) {
      for (std::int64_t k = -4 * kWindow_s; k <= 0; ++k) write(tag, time_of(k));
    }
  }

  /// Returns false at a difference that should not be.
  void slot() {
    const std::int64_t from_s = now_s_;
    now_s_ += kPeriod_s * (below(8) == 0 ? 2 : 1);  // a slot is missed now and then
    for (const char* tag : kTags) {
      for (std::int64_t k = from_s + 1; k <= now_s_; ++k) {
        if (below(20) > 0) write(tag, time_of(k));
      }
    }
    disturb();
    if (below(12) == 0) workers_[below(2)].restart();
    if (below(10) == 0) at_work_ = 1 - at_work_;
    judge();
  }

  std::size_t whole_reads = 0, visits = 0;

 private:
  static constexpr const char* kTags[] = {"1.SP", "1.PV", "1.OP", "2.PV", "2.OP"};

  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }
  static std::int64_t time_of(std::int64_t second) { return (kFirstSlot_s + second) * kSecond_us; }
  void write(const std::string& tag, std::int64_t time_us) {
    archive_.rows(tag).emplace(time_us, tag == "1.SP" ? static_cast<double>(below(3))
                                                      : static_cast<double>(below(1000)) / 8.0);
  }

  /// A row of the past is added, changed, doubled or deleted.
  void disturb() {
    for (std::uint64_t n = below(4); n > 0; --n) {
      const std::string tag = kTags[below(5)];
      // Mostly of the last two slots, now and then from any time.
      const auto reach = static_cast<std::uint64_t>(below(5) == 0 ? 2 * kWindow_s : 2 * kPeriod_s);
      const std::int64_t time_us = time_of(now_s_ - static_cast<std::int64_t>(below(reach)));
      auto& rows = archive_.rows(tag);
      const auto kind = below(3);
      if (kind > 0) rows.erase(time_us);
      if (kind < 2) write(tag, time_us);
      for (storage::ClaimedLoop& claim : loops_.claims) {
        if (!claim.last_slot_end_us) continue;
        const bool is_its =
            tag == claim.loop.sp_tag || tag == claim.loop.pv_tag || tag == claim.loop.op_tag;
        const std::int64_t again_us =
            std::max(settings_->schedule.revise_slots, 1) * kPeriod_s * kSecond_us;
        if (is_its && time_us <= *claim.last_slot_end_us - again_us)
          changed_further_back_.insert(claim.loop.loop_id);
      }
    }
  }

  void judge() {
    std::vector<storage::ClaimedLoop*> batch;
    for (storage::ClaimedLoop& claim : loops_.claims) {
      if (below(6) > 0) batch.push_back(&claim);
    }
    const std::int64_t end_us = time_of(now_s_);
    for (storage::ClaimedLoop* claim : batch) claim->database_now_us = end_us;
    Worker reference(settings_);
    reference.cache->limit(0);
    static_cast<void>(reference.visit(batch, end_us, archive_, as_without_));
    const auto whole = workers_[at_work_].visit(batch, end_us, archive_, results_);
    for (storage::ClaimedLoop* claim : batch) {
      compare(*claim, end_us, whole.contains(claim->loop.loop_id));
      claim->last_slot_end_us = end_us;
    }
  }

  void compare(const storage::ClaimedLoop& claim, std::int64_t end_us, bool whole) {
    const std::int64_t id = claim.loop.loop_id;
    ++visits;
    if (whole) {
      ++whole_reads;
      changed_further_back_.erase(id);
      read_whole_[id] = end_us;
    }
    // No difference lasts longer than the interval between whole reads.
    EXPECT_LE(end_us - read_whole_[id], kWholeReadEvery * kPeriod_s * kSecond_us);
    if (changed_further_back_.contains(id)) return;
    const auto same = [&](std::int64_t slot_us) {
      EXPECT_EQ(results_[std::pair(id, slot_us)], as_without_[std::pair(id, slot_us)])
          << "loop " << id << ", slot " << slot_us / kSecond_us - kFirstSlot_s;
    };
    same(end_us);
    for (const std::int64_t earlier :
         earlier_slots(end_us, claim.last_slot_end_us, claim.loop.period_s,
                       settings_->schedule.revise_slots)) {
      if (as_without_.contains({id, earlier})) same(earlier);
    }
  }

  std::mt19937_64 random_;
  std::shared_ptr<const config::Settings> settings_;
  Worker workers_[2];
  std::size_t at_work_ = 0;
  Archive archive_;
  Loops loops_;
  Results results_, as_without_;
  std::int64_t now_s_ = 0;
  std::set<std::int64_t>
      changed_further_back_;  ///< than what is read again, since the last whole read
  std::map<std::int64_t, std::int64_t> read_whole_;
};

// A thousand plants with late, changed, deleted and doubled rows, missed slots, takeovers and
// restarts, against a run that reads every window whole.
TEST(KeptWindows, GiveWhatWholeReadsGive) {
  std::size_t whole_reads = 0, visits = 0;
  for (std::uint64_t seed = 1; seed <= tests::records(1000) && !HasFailure(); ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    History history(seed);
    for (int slot = 0; slot < 30; ++slot) history.slot();
    whole_reads += history.whole_reads;
    visits += history.visits;
  }
  EXPECT_LT(whole_reads, visits / 2) << "else there was little to compare";
}

/// Two loops of a plant that nobody disturbs.
struct Calm : testing::Test {
  Calm() {
    for (const char* tag : {"1.SP", "1.PV", "1.OP", "2.PV", "2.OP"}) {
      for (std::int64_t k = -4 * kWindow_s; k <= 20 * kPeriod_s; ++k)
        archive.rows(tag).emplace((kFirstSlot_s + k) * kSecond_us, static_cast<double>(k % 7));
    }
  }
  /// Returns whether the first loop's window was read whole.
  bool visit(std::int64_t slot, Worker& worker) {
    storage::ClaimedLoop* loop = &loops.claims[0];
    const std::int64_t end_us = (kFirstSlot_s + slot * kPeriod_s) * kSecond_us;
    loop->database_now_us = end_us;
    const auto whole = worker.visit(std::span(&loop, 1), end_us, archive, results);
    loop->last_slot_end_us = end_us;
    return whole.contains(loop->loop.loop_id);
  }
  Archive archive;
  Loops loops;
  Results results;
};

TEST_F(Calm, WindowsAreReadWholeByTurns) {
  Worker worker(settings_with(1));
  std::vector<std::int64_t> whole;
  for (std::int64_t slot = 0; slot < 20; ++slot) {
    if (visit(slot, worker)) whole.push_back(slot);
  }
  EXPECT_EQ(whole, (std::vector<std::int64_t>{0, 1, 7, 13, 19})) << "the first, then every sixth";
}

TEST_F(Calm, AnotherWorkersSlotMakesAWholeRead) {
  Worker worker(settings_with(1)), other(settings_with(1));
  static_cast<void>(visit(1, worker));
  EXPECT_FALSE(visit(2, worker));
  EXPECT_TRUE(visit(3, other));
  EXPECT_TRUE(visit(4, worker));
}

// Rows that the kept ones do not know of may be behind it.
TEST_F(Calm, AnAnalysisByOtherRowsMakesAWholeRead) {
  Worker worker(settings_with(1));
  static_cast<void>(visit(1, worker));
  results.begin()->second = "revised by another worker";
  EXPECT_TRUE(visit(2, worker));
}

TEST_F(Calm, OtherFactsOrSettingsMakeAWholeRead) {
  Worker worker(settings_with(1));
  static_cast<void>(visit(1, worker));
  loops.claims[0].loop.pv_range = core::signal::OpRange{0.0, 50.0};
  EXPECT_TRUE(visit(2, worker));
  EXPECT_FALSE(visit(3, worker));
  auto moved = std::make_shared<config::Settings>(*worker.settings);
  moved->historians[0].table = "public.other";
  worker.settings = moved;
  EXPECT_TRUE(visit(4, worker));
}

TEST_F(Calm, ASlotThatMovesByMostOfItsWindowIsNotKept) {
  Worker worker(settings_with(1));
  loops.claims[0].loop.period_s = 0.6 * kWindow_s;
  static_cast<void>(visit(1, worker));
  EXPECT_EQ(worker.cache->size().loops, 0U);
}

}  // namespace
}  // namespace loopscope::daemon
