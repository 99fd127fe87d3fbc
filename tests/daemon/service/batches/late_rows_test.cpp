#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>

#include "tests/daemon/service/batches/kept_windows_worker.hpp"
#include "tests/support/long_run.hpp"

namespace loopscope::daemon::kept_windows_tests {
namespace {

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
        const int revised = settings_->schedule.revise_slots;
        const std::int64_t again_us = (revised > 0 ? revised * kPeriod_s : 1) * kSecond_us;
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
TEST(LateRows, GiveWhatWholeReadsGive) {
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

}  // namespace
}  // namespace loopscope::daemon::kept_windows_tests
