#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "config/settings.hpp"
#include "daemon/service/pass.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// The slots of the past that loops are to be judged at: of each loop its slots in their order,
/// because what a window tells of pv and what was said of the loop last goes into the next one; of
/// all loops the oldest first. A slot that is stored, under the algorithm in force, is left as it
/// is, so that a backfill which was stopped goes on where it was; unless `again`, then it is read
/// again and judged where its rows, the catalogue or the settings have changed.
///
/// Work on the newest slots goes first: loops that are due soon, or that others hold, are waited
/// for. Thread-safe.
class PastSlots : public ClaimSource {
 public:
  /// `times_us`: ascending, none twice, not after the newest slot that has settled; a loop's slot
  /// is the end of its period before, or at, each.
  PastSlots(std::shared_ptr<const config::Settings> settings, SharedServices& tools,
            std::vector<storage::CatalogueEntry> loops, std::vector<std::int64_t> times_us,
            bool again);

  std::vector<storage::ClaimedLoop> next(AnalysisWorker& worker) override;
  void done(const std::vector<storage::ClaimedLoop>& claims,
            const storage::WriteCount& count) override;
  [[nodiscard]] std::size_t settled() const override { return settled_; }
  /// Slots of all loops together, done or not.
  [[nodiscard]] std::size_t total() const { return loops_.size() * times_us_.size(); }
  /// Of those, how many were stored before this backfill, and how many lie where pv has no row
  /// (if looked at again: or have not changed).
  [[nodiscard]] std::size_t stored() const;
  [[nodiscard]] std::size_t unrecorded() const;
  /// Loops that were given up: their work failed several times, or nobody could claim them.
  [[nodiscard]] std::vector<std::string> given_up() const;

 private:
  using Clock = std::chrono::steady_clock;
  /// A loop on its way through its slots.
  struct Place {
    storage::CatalogueEntry loop;
    std::size_t next = 0;                                     ///< of times_us_
    int failures = 0;                                         ///< in a row, at this slot
    bool tried = false;                                       ///< at this slot: its row may be ours
    Clock::time_point free_until = Clock::time_point::max();  ///< given up then if not claimed
  };
  using PlaceNumber = std::size_t;

  [[nodiscard]] std::int64_t slot_of(const Place& place) const;
  void wake();
  /// Waits, the lock given up meanwhile, until there may be something to claim.
  void wait(std::unique_lock<std::mutex>& lock);
  /// The oldest slots that are ready, taken out of ready_.
  [[nodiscard]] std::vector<PlaceNumber> take();
  void leave_out_stored(std::vector<PlaceNumber>& places);
  [[nodiscard]] std::vector<storage::ClaimedLoop> claim(AnalysisWorker& worker,
                                                        const std::vector<PlaceNumber>& places);
  /// Loops that could not be claimed come again later, but for those that were disabled meanwhile.
  void wait_for(const std::set<PlaceNumber>& refused);
  /// The slot is done: the place goes on to its next one.
  void advance(PlaceNumber number);
  void put_off(PlaceNumber number, double pause_s);
  void give_up(PlaceNumber number);

  std::shared_ptr<const config::Settings> settings_;
  SharedServices& tools_;
  const std::vector<std::int64_t> times_us_;
  const bool again_;
  ResultsLink results_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<Place> loops_;
  std::map<std::int64_t, PlaceNumber> by_id_;
  std::set<std::pair<std::size_t, PlaceNumber>> ready_;  ///< by time, then loop
  std::multimap<Clock::time_point, PlaceNumber> waiting_;
  std::size_t in_hand_ = 0;
  std::atomic<std::size_t> settled_ =
      0;  ///< read without the lock, which is held while claims wait
  std::size_t stored_ = 0;
  std::size_t unrecorded_ = 0;
  std::vector<std::string> given_up_;
};

}  // namespace loopscope::daemon
